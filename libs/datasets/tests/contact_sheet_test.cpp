#include <gslam/datasets/contact_sheet.h>

#include "export_case.h"

namespace {

using namespace export_case;  // NOLINT(google-build-using-namespace)
using gslam::ArgumentError;
using gslam::ContactSheetOptions;
using gslam::drawContactSheet;
using gslam::Error;

// Frames whose pictures are of one colour each, and a step in depth.
std::unique_ptr<gslam::MemoryDataset> colours(std::size_t count, ImageKind kind = ImageKind::rgb) {
  Case c;
  c.models = {"pinhole"};
  c.kind = kind;
  c.has_depth = true;
  c.frames = count;
  const gslam::DatasetInfo info = c.info();
  auto frames = c.makeFrames(info);
  for (std::size_t i = 0; i < count; ++i) {
    const auto changed = std::make_shared<Frame>(*frames[i]);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int channel = 0; channel < changed->images[0].image.channels(); ++channel) {
          changed->images[0].image.at<std::uint8_t>(x, y, channel) =
              static_cast<std::uint8_t>(channel == 0 ? 250 : 10 * i);
        }
        changed->images[1].image.at<std::uint16_t>(x, y) =
            static_cast<std::uint16_t>(x < 10   ? 0
                                       : x < 25 ? 1000
                                                : 4000);
      }
    }
    frames[i] = changed;
  }
  return std::make_unique<gslam::MemoryDataset>(info, frames);
}

// How many pixels of the sheet are of this colour.
int countOf(const Image& sheet, int red, int green, int blue) {
  int count = 0;
  for (int y = 0; y < sheet.height(); ++y) {
    for (int x = 0; x < sheet.width(); ++x) {
      count += sheet.at<std::uint8_t>(x, y, 0) == red && sheet.at<std::uint8_t>(x, y, 1) == green &&
               sheet.at<std::uint8_t>(x, y, 2) == blue;
    }
  }
  return count;
}

TEST(ContactSheet, HasEveryFrameInItsColours) {
  const auto dataset = colours(7);
  ContactSheetOptions options;
  options.width = 900;
  const Image sheet = drawContactSheet(*dataset, options);
  EXPECT_EQ(sheet.width(), 900);
  EXPECT_EQ(sheet.channels(), 3);
  // Two frames of two images side by side: about 220 x 165 pixels each.
  for (int i = 0; i < 7; ++i) EXPECT_GT(countOf(sheet, 250, 10 * i, 10 * i), 200 * 150) << i;
}

TEST(ContactSheet, BlueGreenRedAreTurned) {
  const auto dataset = colours(2, ImageKind::bgr);
  const Image sheet = drawContactSheet(*dataset);
  EXPECT_GT(countOf(sheet, 10, 10, 250), 1000);
  EXPECT_EQ(countOf(sheet, 250, 10, 10), 0);
}

TEST(ContactSheet, DepthIsRedNearBlueFarBlackWhereThereIsNone) {
  const auto dataset = colours(1);
  ContactSheetOptions options;
  options.width = 1000;
  options.columns = 1;
  const Image sheet = drawContactSheet(*dataset, options);
  // The right half is the depth, 493 pixels wide: a quarter none, then near, then far.
  const int y = 200;
  const auto pixel = [&](int x, int c) { return int(sheet.at<std::uint8_t>(x, y, c)); };
  for (int c = 0; c < 3; ++c) EXPECT_EQ(pixel(550, c), 0);
  EXPECT_GT(pixel(700, 0), pixel(700, 2) + 100) << "red";
  EXPECT_GT(pixel(900, 2), pixel(900, 0) + 100) << "blue";
}

TEST(ContactSheet, FramesAreSpreadOverTheDataset) {
  const auto dataset = colours(21);
  ContactSheetOptions options;
  options.frames = 3;
  const Image sheet = drawContactSheet(*dataset, options);
  for (int i = 0; i < 21; ++i) {
    const bool is_there = i == 0 || i == 10 || i == 20;
    EXPECT_EQ(countOf(sheet, 250, 10 * i, 10 * i) > 1000, is_there) << i;
  }
}

TEST(ContactSheet, EveryKindAndTypeIsDrawn) {
  const ImageKind kinds[] = {ImageKind::grey,      ImageKind::rgb,  ImageKind::bayer,
                             ImageKind::depth,     ImageKind::mask, ImageKind::label,
                             ImageKind::disparity, ImageKind::rgba, ImageKind::infrared};
  for (const ImageKind kind : kinds) {
    for (int type = 0; type <= 10; ++type) {
      for (int channels = 1; channels <= 5; ++channels) {
        gslam::DatasetInfo info;
        const auto frame = std::make_shared<Frame>();
        CameraImage image;
        image.image = Image(20, 10, static_cast<PixelType>(type), channels);
        image.kind = kind;
        frame->images = {image, CameraImage()};
        gslam::MemoryDataset dataset(info, {frame});
        EXPECT_EQ(drawContactSheet(dataset).width(), 1600);
      }
    }
  }
}

class Failing : public gslam::MemoryDataset {
 public:
  Failing(const Case& c, bool all) : MemoryDataset(c.info(), c.makeFrames(c.info())), all_(all) {}
  std::shared_ptr<const Frame> next() override {
    std::shared_ptr<const Frame> frame = MemoryDataset::next();
    if (frame != nullptr && (all_ || frame->id == 1)) {
      throw gslam::FileError("1.png", "is truncated");
    }
    return frame;
  }

 private:
  bool all_;
};

TEST(ContactSheet, UnreadableFramesKeepTheirPlace) {
  Failing dataset(Case(), false);
  EXPECT_FALSE(drawContactSheet(dataset).empty());
  Failing nothing(Case(), true);
  EXPECT_THROW(drawContactSheet(nothing), Error);
}

TEST(ContactSheet, FramesWithoutImages) {
  gslam::MemoryDataset dataset(gslam::DatasetInfo(), {std::make_shared<Frame>()});
  EXPECT_FALSE(drawContactSheet(dataset).empty());
  gslam::MemoryDataset none(gslam::DatasetInfo(), {});
  EXPECT_THROW(drawContactSheet(none), Error);
}

TEST(ContactSheet, OptionsOutOfRange) {
  const auto dataset = colours(2);
  const auto draw = [&](std::size_t frames, int width, int columns) {
    ContactSheetOptions options;
    options.frames = frames;
    options.width = width;
    options.columns = columns;
    drawContactSheet(*dataset, options);
  };
  EXPECT_THROW(draw(0, 1600, 0), ArgumentError);
  EXPECT_THROW(draw(1001, 1600, 0), ArgumentError);
  EXPECT_THROW(draw(std::numeric_limits<std::size_t>::max(), 1600, 0), ArgumentError);
  EXPECT_THROW(draw(20, 63, 0), ArgumentError);
  EXPECT_THROW(draw(20, 20000, 0), ArgumentError);
  EXPECT_THROW(draw(20, -1, 0), ArgumentError);
  EXPECT_THROW(draw(20, 1600, -1), ArgumentError);
  EXPECT_THROW(draw(20, 64, 2), ArgumentError) << "no room for four images";
}

TEST(ContactSheet, FileHasTheSamePixels) {
  const NewFolder folder;
  const auto dataset = colours(4);
  writeContactSheet(*dataset, folder / "sheet.png");
  EXPECT_TRUE(samePixels<std::uint8_t>(readImage(folder / "sheet.png"), drawContactSheet(*dataset),
                                       {2, 1, 0}));
  EXPECT_THROW(writeContactSheet(*dataset, folder / "none/sheet.png"), gslam::FileError);
  EXPECT_THROW(writeContactSheet(*dataset, "/dev/full"), gslam::FileError);
}

}  // namespace
