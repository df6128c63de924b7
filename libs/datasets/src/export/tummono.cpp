// TUM monoVO.
//
// J. Engel, V. Usenko, D. Cremers, "A photometrically calibrated benchmark for monocular visual
// odometry", arXiv:1607.02555. Images are in the folder images/, where its readers look before they
// look for images.zip; the original has JPEG files of the same names.
#include <memory>
#include <string>

#include "camera_text.h"
#include "layouts.h"
#include "photometric.h"
#include "pixels.h"
#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

class Tummono : public Layout {
 public:
  explicit Tummono(Source& from) : Layout(from) {
    source.keepCameras(1);
    source.needModel(0);
    if (dsoCameraText(source.camera(0).camera).empty()) source.failModel(0, dsoCameraModels());
    source.dropDepth();
    source.dropImu();
    source.dropGnss();
    notePhotometric(source);
  }

  void begin(ExportFolder& folder) override {
    folder_ = &folder;
    folder.makeFolder("images");
    folder.write("camera.txt", dsoCameraText(source.camera(0).camera));
    writePhotometric(folder, "", source.camera(0).camera);
    times_ = &folder.openText("times.txt");
    if (!source.info().ground_truth.empty()) truth_ = &folder.openText("groundtruthSync.txt");
  }

  void prepare(const Frame& frame) override {
    const CameraImage* const image = source.image(frame, 0);
    if (image == nullptr)
      throw Error("there is no image of camera '" + source.camera(0).name + "'");
    image_ = greyPng(*image, source.camera(0), source.notes);
    exposure_ = exposureText(image->exposure, source.notes);
    stamp_ = frame.stamp;
  }

  void commit() override {
    const std::string index = paddedText(index_++, 5);
    folder_->write("images/" + index + ".png", image_);
    times_->line(Row(" ").text(index).seconds(stamp_).text(exposure_).str());
    if (truth_ == nullptr) return;
    SE3d pose;
    Row row(" ");
    row.seconds(stamp_);
    if (source.poseAt(stamp_, source.camera(0).T_body_camera, pose)) {
      row.poseXyzw(pose);
    } else {
      row.text("NaN NaN NaN NaN NaN NaN NaN");  // as the original between begin and end
    }
    truth_->line(row.str());
  }

 private:
  ExportFolder* folder_ = nullptr;
  TextFile* times_ = nullptr;
  TextFile* truth_ = nullptr;
  Bytes image_;  // of the frame in work
  std::string exposure_;
  std::int64_t stamp_ = 0;
  std::size_t index_ = 0;
};

}  // namespace

std::unique_ptr<Layout> makeTummono(Source& source) {
  return std::make_unique<Tummono>(source);
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
