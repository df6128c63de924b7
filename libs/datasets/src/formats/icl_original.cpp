// scene_00_0000.png, scene_00_0000.depth, scene_00_0000.txt: the image, the distance of each pixel
// along its ray as text, and the camera.
//
// A. Handa et al., "A benchmark for RGB-D visual odometry, 3D reconstruction and SLAM", ICRA 2014;
// the layout is that of "code_to_parse_povray_rendering" of its authors' living_room_iclnuim: z is
// cam_dir, x is cam_up x z, y is z x x, the focal lengths are |cam_dir| by |cam_right| widths and
// |cam_dir| heights. The living room (four digits) is in metres, the older office
// (scene_000.png, three digits) in centimetres.
#include "icl_original.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../calibration/formats.h"
#include "../reading/decode.h"
#include "../reading/sort_unique.h"
#include "icl_mirror.h"
#include "number_file.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr double kBackground = 1e5;  // POV-Ray's distance of what no ray hits is 1e7

// The lines `name = [x, y, z]';` of a file.
class PovVectors {
 public:
  PovVectors(const FileTree& tree, const std::string& file)
      : text_(tree.text(file)), source_(tree.nameOf(file)) {}

  Vec3d get(const std::string& name) const {
    const std::size_t begin = find(name);
    const std::size_t open = text_.find('[', begin), close = text_.find(']', begin);
    const std::size_t line_end = std::min(text_.find('\n', begin), text_.size());
    if (open == std::string::npos || close == std::string::npos || close > line_end || open > close)
      fail(begin, name);
    const std::string numbers = text_.substr(open + 1, close - open - 1);
    try {
      const std::vector<double> v = numbersOf(numbers, source_, 3, "x, y, z");
      return {{v[0], v[1], v[2]}};
    } catch (const ParseError&) {
      fail(begin, name);
    }
  }

  // Its length must not be 0.
  Vec3d direction(const std::string& name) const {
    const Vec3d v = get(name);
    if (!(v.norm() > 0)) fail(find(name), name);
    return v;
  }

  [[noreturn]] void fail(std::size_t place, const std::string& name) const {
    const std::size_t end = std::min(place, text_.size());
    const auto line_ends = std::count(text_.begin(), text_.begin() + std::ptrdiff_t(end), '\n');
    throw ParseError(source_, static_cast<std::size_t>(line_ends) + 1, 0,
                     "expected a line " + name + " = [x, y, z]'; of a camera of POV-Ray");
  }

 private:
  std::size_t find(const std::string& name) const {
    for (std::size_t at = text_.find(name); at != std::string::npos;
         at = text_.find(name, at + 1)) {
      const bool is_begin = at == 0 || text_[at - 1] == '\n' || text_[at - 1] == ' ';
      const char after = at + name.size() < text_.size() ? text_[at + name.size()] : '\n';
      if (is_begin && (after == ' ' || after == '=' || after == '\t')) return at;
    }
    fail(text_.size(), name);
  }

  std::string text_;
  std::string source_;
};

Mat3d matrixOfColumns(const Vec3d& x, const Vec3d& y, const Vec3d& z) {
  Mat3d m{};
  for (std::size_t i = 0; i < 3; ++i) {
    m(i, 0) = x[i];
    m(i, 1) = y[i];
    m(i, 2) = z[i];
  }
  return m;
}

struct OriginalFrame {
  std::size_t number = 0;
  std::string base;  // "scene_00_0012", in the tree
};

// The number behind the last _: 12 of "scene_00_0012".
bool frameNumber(const std::string& base, std::size_t& number) {
  const std::size_t place = base.rfind('_');
  return place != std::string::npos && numberIn(base.substr(place), number);
}

std::vector<OriginalFrame> listFrames(const FileTree& tree, const std::string& folder,
                                      Remarks& remarks) {
  std::vector<OriginalFrame> frames;
  for (const std::string& name : tree.files(folder)) {
    OriginalFrame frame;
    const bool is_image =
        name.compare(0, 6, "scene_") == 0 && name.size() > 10 && endsWith(name, ".png");
    if (!is_image || !frameNumber(name.substr(0, name.size() - 4), frame.number)) continue;
    frame.base = joined(folder, name.substr(0, name.size() - 4));
    frames.push_back(std::move(frame));
  }
  sortUnique(
      frames, [](const OriginalFrame& frame) { return frame.number; },
      [&remarks](const OriginalFrame& twin) {
        remarks.skip("images whose number another one has", twin.base);
      });
  return frames;
}

// "scene_00_0012" of the living room is in metres, "scene_012" of the office in centimetres.
double usualUnit(const std::string& base) {
  const std::string name = nameIn(base);
  return std::count(name.begin(), name.end(), '_') >= 2 ? 1 : 0.01;
}

class OriginalReader {
 public:
  OriginalReader(Sequence& sequence, std::shared_ptr<const FileTree> tree, double unit)
      : sequence_(sequence), tree_(std::move(tree)), unit_(unit) {}

  void open(const std::string& folder, bool wants_depth) {
    frames_ = listFrames(*tree_, folder, sequence_.remarks);
    if (wants_depth) skipWithoutDepth();
    if (frames_.empty()) throw FileError(tree_->nameOf(folder), "has no frame scene_00_0000.png");
    if (unit_ == 0) unit_ = usualUnit(frames_[0].base);
    sequence_.remarks.say(unit_ == 1 ? "lengths are taken to be in metres, as the living room's are"
                                     : "1 of the files is taken to be " + std::to_string(unit_) +
                                           " m; parameter unit sets it");
    readPoses();
    loadColour();
    if (wants_depth) addDepth();
  }

 private:
  void skipWithoutDepth() {
    std::vector<OriginalFrame> whole;
    for (OriginalFrame& frame : frames_) {
      if (tree_->has(frame.base + ".depth")) {
        whole.push_back(std::move(frame));
      } else {
        sequence_.remarks.skip("frames without depth", frame.base);
      }
    }
    frames_ = std::move(whole);
  }

  void readPoses() {
    for (const OriginalFrame& frame : frames_) {
      const std::int64_t stamp = stampAtRate(frame.number, kIclRate);
      sequence_.stamps.push_back(stamp);
      if (!tree_->has(frame.base + ".txt")) {
        sequence_.remarks.skip("cameras that have no file", frame.base + ".txt");
        continue;
      }
      const PovCamera camera = readPovCamera(*tree_, frame.base + ".txt", unit_);
      if (camera_file_.empty()) {
        camera_ = camera;
        camera_file_ = frame.base + ".txt";
      }
      sequence_.info.ground_truth.add(stamp, camera.T_world_camera);
    }
  }

  void loadColour() {
    const ImageShape shape = shapeOfFile(*tree_, frames_[0].base + ".png");
    const double width = shape.width, height = shape.height;
    const bool is_known = !camera_file_.empty();
    if (!is_known)
      sequence_.remarks.say("the calibration is the published one, 481.2 480 319.5 239.5");
    const double fx = (is_known ? camera_.fx_by_width : 481.2 / 640) * width;
    const double fy = (is_known ? camera_.fy_by_height : 1) * height;
    const Camera camera = calibration::makeCamera(tree_->nameOf(camera_file_), 0, "pinhole",
                                                  {shape.width, shape.height},
                                                  {fx, fy, (width - 1) / 2, (height - 1) / 2});
    sequence_.info.sensors.cameras.push_back(cameraOf("rgb", camera));
    ImageFiles files;
    files.tree = tree_;
    for (const OriginalFrame& frame : frames_) files.names.push_back(frame.base + ".png");
    loadImageFiles(sequence_, std::move(files));
  }

  void addDepth() {
    CameraSensor depth = sequence_.info.sensors.cameras[0];
    depth.name = "depth";
    depth.kind = ImageKind::depth;
    depth.depth_scale = 1;
    sequence_.info.sensors.cameras.push_back(depth);
    std::vector<std::string> names;
    for (const OriginalFrame& frame : frames_) names.push_back(frame.base + ".depth");
    sequence_.load = [colour = sequence_.load, tree = tree_, names, model = depth.camera,
                      unit = unit_](std::size_t frame, std::size_t camera) {
      return camera == 0 ? colour(frame, 0) : readRayDistances(*tree, names[frame], model, unit);
    };
  }

  Sequence& sequence_;
  std::shared_ptr<const FileTree> tree_;
  double unit_;
  std::vector<OriginalFrame> frames_;
  PovCamera camera_;
  std::string camera_file_;  // that it is of; "": there is none
};

}  // namespace

PovCamera readPovCamera(const FileTree& tree, const std::string& file, double unit) {
  const PovVectors vectors(tree, file);
  const Vec3d dir = vectors.direction("cam_dir"), up = vectors.direction("cam_up");
  const Vec3d right = vectors.direction("cam_right"), position = vectors.get("cam_pos");
  const Vec3d z = dir / dir.norm();
  const Vec3d across = up.cross(z);
  if (!(across.norm() > 1e-9)) vectors.fail(0, "cam_up, which is no multiple of cam_dir,");
  const Vec3d x = across / across.norm();
  const SO3d rotation = SO3d::fromMatrix(matrixOfColumns(x, z.cross(x), z));
  PovCamera camera;
  camera.T_world_camera = mirroredInY(SE3d(rotation, position * unit));
  camera.fx_by_width = dir.norm() / right.norm();
  camera.fy_by_height = dir.norm();
  return camera;
}

Image readRayDistances(const FileTree& tree, const std::string& file, const Camera& camera,
                       double unit) {
  const std::size_t width = static_cast<std::size_t>(camera.width());
  const std::size_t count = width * static_cast<std::size_t>(camera.height());
  const std::vector<double> distances =
      readNumbers(tree, file, count, "the distance of each pixel, row by row");
  const std::vector<double> p = camera.parameters();
  Image depth(camera.width(), camera.height(), PixelType::f32);
  for (int v = 0; v < camera.height(); ++v) {
    float* const row = depth.row<float>(v);
    const double y = (v - p[3]) / p[1];
    for (int u = 0; u < camera.width(); ++u) {
      const double distance = distances[static_cast<std::size_t>(v) * width + std::size_t(u)];
      const double x = (u - p[2]) / p[0];
      const bool is_hit = distance > 0 && distance < kBackground;
      row[u] = is_hit ? static_cast<float>(distance * unit / std::sqrt(x * x + y * y + 1)) : 0;
    }
  }
  return depth;
}

void openIclOriginal(Sequence& sequence, const std::shared_ptr<const FileTree>& tree,
                     const std::string& folder, bool wants_depth, double unit) {
  OriginalReader(sequence, tree, unit).open(folder, wants_depth);
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
