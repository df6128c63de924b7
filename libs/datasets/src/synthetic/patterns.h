// The brightness of each material, 0 to 1, at a place in metres; y is up on walls.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_PATTERNS_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_PATTERNS_H

#include "brush.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

// Distance to the border of a cell, as a part of it, where the cell is `width` by `height`.
inline float borderDistance(const Cell& cell, float width, float height) {
  return std::min(std::min(cell.x, 1 - cell.x) * width, std::min(cell.y, 1 - cell.y) * height);
}

struct Wallpaper {
  Brush brush;
  float operator()(float x, float y) const {
    const float ground = 0.62F + 0.10F * brush.soft(x, y, 0.8F) + 0.10F * brush.grain(x, y, 0.012F);
    if (y < 0.9F) {  // a panel of wood, with a rail
      if (y > 0.84F) return 0.25F + 0.1F * brush.grain(x, y * 4, 0.01F);
      const Cell panel = cellOf(x, y, 0.31F, 2);
      const float gap = std::min(panel.x, 1 - panel.x) < 0.02F ? -0.25F : 0.0F;
      return 0.45F + gap + 0.15F * brush.grain(6 * x, y, 0.02F) +
             0.12F * brush.value(panel.i, 0, 3);
    }
    return ground + 0.24F * brush.blobs(x, y, 0.19F, 4) +
           0.2F * brush.blobs(x + 3, y + 7, 0.11F, 5);
  }
};

struct Plaster {
  Brush brush;
  float operator()(float x, float y) const {
    const float stain = brush.soft(x, y, 0.6F);
    return 0.66F + 0.16F * stain + 0.16F * brush.grain(x, y, 0.011F) +
           0.2F * std::min(0.0F, brush.blobs(x, y, 0.12F, 6, true)) +
           (stain > 0.55F ? -0.2F : 0.0F);
  }
};

struct Bricks {
  Brush brush;
  float operator()(float x, float y) const {
    const int row = static_cast<int>(std::floor(y / 0.09F));
    const Cell brick = cellOf(x + (row % 2 == 0 ? 0.0F : 0.13F), y, 0.26F, 0.09F);
    const float grain = brush.grain(x, y, 0.008F);
    if (borderDistance(brick, 0.26F, 0.09F) < 0.007F) return 0.82F + 0.14F * grain;
    return 0.30F + 0.34F * brush.value(brick.i, brick.j, 1) + 0.16F * grain +
           0.06F * brush.soft(x, y, 1);
  }
};

struct Planks {
  Brush brush;
  float operator()(float x, float y) const {
    const int row = static_cast<int>(std::floor(y / 0.14F));
    const Cell plank = cellOf(x + 1.3F * brush.value(row, 0, 1), y, 1.3F, 0.14F);
    if (borderDistance(plank, 1.3F, 0.14F) < 0.004F) return 0.08F;
    const float knot = std::min(0.0F, brush.blobs(x, y, 0.14F, 2));
    return 0.38F + 0.34F * brush.value(plank.i, plank.j, 3) +
           0.16F * brush.grain(x, 7 * y, 0.014F) + 0.10F * brush.grain(x, y, 0.009F) +
           0.2F * (knot < -0.8F ? knot : 0.0F);
  }
};

struct Tiles {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell tile = cellOf(x, y, 0.33F, 0.33F);
    if (borderDistance(tile, 0.33F, 0.33F) < 0.006F) return 0.15F + 0.1F * brush.grain(x, y, 0.01F);
    const float tone = ((tile.i + tile.j) % 2 == 0 ? 0.34F : 0.66F) +
                       0.3F * (brush.value(tile.i, tile.j, 1) - 0.5F);
    return tone + 0.2F * brush.grain(x, y, 0.010F) + 0.12F * brush.blobs(x, y, 0.11F, 2);
  }
};

struct Carpet {
  Brush brush;
  float width, height;
  float operator()(float x, float y) const {
    const float border = std::min(std::min(x, width - x), std::min(y, height - y));
    const float weave = 0.2F * brush.grain(x, y, 0.008F);
    if (border < 0.06F) return 0.2F + weave;
    if (border < 0.12F) return 0.8F + weave;
    return 0.45F + weave + 0.3F * brush.blobs(x, y, 0.22F, 1) + 0.12F * brush.soft(x, y, 0.4F);
  }
};

struct Concrete {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell slab = cellOf(x, y, 1.2F, 1.2F);
    if (borderDistance(slab, 1.2F, 1.2F) < 0.008F) return 0.2F;
    return 0.5F + 0.1F * brush.value(slab.i, slab.j, 1) + 0.14F * brush.soft(x, y, 0.5F) +
           0.22F * brush.grain(x, y, 0.010F) +
           0.25F * std::min(0.0F, brush.blobs(x, y, 0.13F, 2, true));
  }
};

struct Ceiling {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell panel = cellOf(x, y, 0.6F, 0.6F);
    if (borderDistance(panel, 0.6F, 0.6F) < 0.012F) return 0.35F;
    if (brush.bits(panel.i, panel.j, 1) % 9 == 0) return 1;  // a lamp
    const float holes = brush.grain(x, y, 0.008F) > 0.45F ? -0.3F : 0.0F;
    return 0.66F + 0.14F * brush.value(panel.i, panel.j, 2) + holes;
  }
};

struct Poster {
  Brush brush;
  float width, height;
  float operator()(float x, float y) const {
    const float border = std::min(std::min(x, width - x), std::min(y, height - y));
    if (border < 0.015F) return 0.05F;
    if (border < 0.05F) return 0.95F;
    const float down = height - y;
    if (down < 0.3F * height) {  // its title
      return brush.text(x, down, 0.08F * height, 1) ? 0.05F : 0.88F;
    }
    if (down > 0.72F * height) return brush.text(x, down, 0.025F, 2) ? 0.15F : 0.9F;
    const float size = 0.2F + 0.2F * brush.value(1, 1, 3);
    return 0.5F + 0.3F * brush.soft(x, y, 0.3F) + 0.4F * brush.blobs(x, y, size, 4) +
           0.25F * brush.blobs(x + 9, y, 0.09F, 5) + 0.08F * brush.grain(x, y, 0.01F);
  }
};

// A board with sheets of paper.
struct Notices {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell sheet = cellOf(x, y, 0.27F, 0.36F);
    const float left = 0.02F + 0.1F * brush.value(sheet.i, sheet.j, 1);
    const float low = 0.02F + 0.15F * brush.value(sheet.i, sheet.j, 2);
    const bool is_paper = sheet.x > left && sheet.x < left + 0.78F && sheet.y > low &&
                          sheet.y < low + 0.76F && brush.bits(sheet.i, sheet.j, 3) % 8 != 0;
    if (!is_paper) return 0.35F + 0.25F * brush.grain(x, y, 0.008F);
    const float paper = 0.7F + 0.3F * brush.value(sheet.i, sheet.j, 4);
    if (brush.bits(sheet.i, sheet.j, 5) % 3 == 0) {
      return paper - 0.3F + 0.4F * brush.blobs(x, y, 0.09F, 6) + 0.2F * brush.soft(x, y, 0.1F);
    }
    return brush.text(x, -y, 0.02F, 7) ? 0.12F : paper;
  }
};

struct Books {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell shelf = cellOf(0, y, 1, 0.34F);
    if (shelf.y < 0.08F) return 0.55F + 0.2F * brush.grain(x, 6 * y, 0.01F);
    const Cell pair = cellOf(x + 0.37F * static_cast<float>(shelf.j), 0, 0.09F, 1);
    const float cut = 0.3F + 0.4F * brush.value(pair.i, shelf.j, 1);
    const int book = 2 * pair.i + (pair.x > cut ? 1 : 0);
    const float height = 0.62F + 0.33F * brush.value(book, shelf.j, 2);
    if (shelf.y > height) return 0.04F;
    const float tone = 0.15F + 0.7F * brush.value(book, shelf.j, 3);
    const float edge = std::min(std::fabs(pair.x - cut), std::min(pair.x, 1 - pair.x)) * 0.09F;
    if (edge < 0.003F) return 0.03F;
    const float band = 0.2F + 0.5F * brush.value(book, shelf.j, 4);
    if (std::fabs(shelf.y - band) < 0.06F) return tone > 0.5F ? 0.1F : 0.9F;
    if (brush.text(y, x, 0.02F, 5) && shelf.y > 0.3F) return tone > 0.5F ? 0.15F : 0.85F;
    return tone + 0.08F * brush.grain(x, y, 0.01F);
  }
};

struct Crate {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell board = cellOf(x, y, 3, 0.13F);
    if (std::min(board.y, 1 - board.y) * 0.13F < 0.005F) return 0.06F;
    const float wood = 0.42F + 0.28F * brush.value(0, board.j, 1) +
                       0.18F * brush.grain(x, 8 * y, 0.014F) + 0.1F * brush.grain(x, y, 0.008F);
    const Cell label = cellOf(x, y, 0.5F, 0.42F);
    if (label.x > 0.2F && label.x < 0.75F && label.y > 0.3F && label.y < 0.65F) {
      return brush.text(x, -y, 0.035F, 2) ? 0.08F : 0.92F;
    }
    return wood + 0.3F * std::min(0.0F, brush.blobs(x, y, 0.12F, 3, true));
  }
};

struct Fabric {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell stripe = cellOf(x, y, 0.16F, 0.16F);
    const float check = ((stripe.x < 0.5F) != (stripe.y < 0.5F)) ? 0.12F : -0.12F;
    return 0.48F + check + 0.22F * brush.grain(x, y, 0.009F) + 0.28F * brush.blobs(x, y, 0.12F, 1);
  }
};

struct Metal {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell band = cellOf(x, y, 0.4F, 0.3F);
    const float ring = band.y < 0.08F ? -0.3F : 0.0F;
    const float rust = brush.soft(x, y, 0.2F) > 0.35F ? -0.25F : 0.0F;
    return 0.62F + ring + rust + 0.15F * brush.grain(x, y, 0.010F) +
           0.25F * brush.blobs(x, y, 0.13F, 1, true);
  }
};

struct Bark {
  Brush brush;
  float operator()(float x, float y) const {
    return 0.45F + 0.45F * brush.grain(3 * x, y, 0.03F) + 0.25F * brush.grain(x, y, 0.02F);
  }
};

struct Leaves {
  Brush brush;
  float operator()(float x, float y) const {
    return 0.45F + 0.3F * brush.blobs(x, y, 0.21F, 1, true) +
           0.25F * brush.blobs(x + 5, y, 0.37F, 2, true) + 0.3F * brush.grain(x, y, 0.04F);
  }
};

// Floors of windows; of a shop the lowest has panes, signs and doors.
struct Facade {
  Brush brush;
  int is_shop;
  float operator()(float x, float y) const {
    const Cell bay = cellOf(x, y, 2.6F, 3.1F);
    const float wall = 0.56F + 0.08F * brush.soft(x, y, 3) + 0.16F * brush.grain(x, y, 0.03F);
    if (is_shop != 0 && y < 3.1F) return ground(x, y, bay, wall);
    if (bay.y < 0.04F) return 0.8F + 0.1F * brush.grain(x, y, 0.03F);
    const float dx = std::fabs(bay.x - 0.5F) * 2.6F, dy = std::fabs(bay.y - 0.52F) * 3.1F;
    if (dx > 0.72F || dy > 0.95F) return brickWall(x, y, wall);
    if (dx > 0.62F || dy > 0.85F || dx < 0.035F) return 0.93F;  // frames
    const float blind = brush.value(bay.i, bay.j, 1);
    if (bay.y > 0.85F - 0.5F * blind) return 0.7F + 0.2F * std::floor(4 * blind) / 4;
    return 0.12F + 0.2F * brush.value(bay.i, bay.j, 2) + 0.18F * brush.soft(x, y, 0.5F);
  }

 private:
  float brickWall(float x, float y, float wall) const {
    const Cell stone =
        cellOf(x + (static_cast<int>(std::floor(y / 0.2F)) % 2 == 0 ? 0.0F : 0.3F), y, 0.6F, 0.2F);
    if (borderDistance(stone, 0.6F, 0.2F) < 0.015F) return wall + 0.2F;
    return wall - 0.2F + 0.3F * brush.value(stone.i, stone.j, 3);
  }
  float ground(float x, float y, const Cell& bay, float wall) const {
    if (y > 2.5F) {
      return brush.text(x, 3.1F - y, 0.28F, 4) ? 0.92F : 0.15F + 0.2F * brush.value(bay.i, 0, 5);
    }
    if (bay.x < 0.08F || bay.x > 0.92F) return wall;
    if (y < 0.4F) return 0.3F + 0.2F * brush.grain(x, y, 0.03F);
    return 0.3F + 0.35F * brush.blobs(x, y, 0.45F, 6) + 0.2F * brush.soft(x, y, 0.6F) +
           (brush.text(x, -y, 0.1F, 7) && bay.y > 0.45F ? 0.35F : 0.0F);
  }
};

// A road along its longer edge.
struct Asphalt {
  Brush brush;
  float width, height;
  float operator()(float x, float y) const {
    const bool is_along_x = width > height;
    const float along = is_along_x ? x : y, across = is_along_x ? y : x;
    const float middle = std::fabs(across - 0.5F * std::min(width, height));
    const float worn = brush.grain(x, y, 0.03F);
    if (middle < 0.08F && along / 6 - std::floor(along / 6) < 0.5F) return 0.85F + 0.2F * worn;
    if (std::fabs(middle - 3.6F) < 0.07F) return 0.78F + 0.2F * worn;
    const Cell patch = cellOf(x, y, 3.7F, 2.9F);
    const float tone = brush.bits(patch.i, patch.j, 1) % 4 == 0 ? -0.12F : 0.0F;
    const float crack = std::fabs(brush.soft(x, y, 2)) < 0.02F ? -0.2F : 0.0F;
    return 0.36F + tone + crack + 0.28F * worn + 0.1F * brush.soft(x, y, 4) +
           0.25F * brush.blobs(x, y, 0.57F, 2, true) *
               (brush.bits(patch.i, patch.j, 3) % 3 == 0 ? 1.0F : 0.2F);
  }
};

struct Pavement {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell slab = cellOf(x, y, 0.6F, 0.6F);
    if (borderDistance(slab, 0.6F, 0.6F) < 0.02F) return 0.2F;
    return 0.4F + 0.35F * brush.value(slab.i, slab.j, 1) + 0.25F * brush.grain(x, y, 0.03F);
  }
};

struct Car {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell part = cellOf(x, y, 1.3F, 10);
    if (y < 0.12F) return 0.05F;
    if (borderDistance(part, 1.3F, 10) < 0.015F) return 0.1F;
    if (y > 0.75F && part.x > 0.1F && part.x < 0.9F) return 0.16F + 0.3F * brush.soft(x, y, 0.4F);
    return 0.6F + 0.12F * brush.soft(x, y, 0.7F) + 0.25F * brush.blobs(x, y, 0.3F, 1) +
           0.1F * brush.grain(x, y, 0.03F);
  }
};

struct Roof {
  Brush brush;
  float operator()(float x, float y) const {
    const Cell tile = cellOf(x, y, 0.7F, 0.9F);
    const float chimney = brush.blobs(x, y, 4.3F, 1);
    if (chimney > 0.6F) return 0.95F;
    return 0.35F + 0.3F * brush.value(tile.i, tile.j, 2) + 0.3F * brush.grain(x, y, 0.3F) +
           (borderDistance(tile, 0.7F, 0.9F) < 0.1F ? -0.15F : 0.0F);
  }
};

// Fields with furrows, woods, paths.
struct Land {
  Brush brush;
  float operator()(float x, float y) const {
    const float bend = 9 * brush.soft(x, y, 60);
    const Cell field = cellOf(x + bend, y - bend, 46, 37);
    const float edge = borderDistance(field, 46, 37);
    const float grain = brush.grain(x, y, 0.35F);
    if (edge < 1.6F) return 0.8F + 0.2F * grain;
    if (edge < 2.6F) return 0.25F + 0.2F * grain;
    const std::uint32_t kind = brush.bits(field.i, field.j, 1) % 4;
    const float tone = 0.3F + 0.35F * brush.value(field.i, field.j, 2);
    const float rough = tone + 0.22F * grain + 0.08F * brush.soft(x, y, 20);
    if (kind == 0) return rough - 0.08F + 0.35F * brush.blobs(x, y, 2.9F, 3, true);
    if (kind == 1) return rough + ((field.x * 30 - std::floor(field.x * 30)) < 0.5F ? 0.1F : -0.1F);
    if (kind == 2) return rough + 0.2F * brush.blobs(x, y, 5.3F, 4, true);
    return rough;
  }
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_PATTERNS_H
