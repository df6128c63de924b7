#include "mapping/mapping.h"
#include "pipeline.h"
#include "tracking/patience.h"

namespace visual {
namespace {

using gslam::KeyframeId;
using gslam::TrackingState;

class SequentialPipeline : public Pipeline {
 public:
  SequentialPipeline(const Options& options, const Eye& eye)
      : options_(options),
        places_(options.loop, options.seed),
        relocalizer_(options, places_),
        mapping_(options, eye, places_),
        tracker_(options, relocalizer_),
        detector_(options, places_) {}

  Tracked step(const std::shared_ptr<const View>& view) override {
    has_restarted_ = false;
    if (!mapping_.hasBegun()) return start(view);
    Tracked tracked = tracker_.track(view, mapping_.scene(), true);
    if (patience_.isOver(tracked.state, mapping_.scene().map.keyframes().size())) {
      has_restarted_ = true;
      patience_.reset();
      mapping_.reset();
      detector_.reset();
      return start(view);
    }
    if (tracked.is_keyframe_due) addKeyframe();
    return tracked;
  }

  void finish() override {}

  std::shared_ptr<const Scene> scene() override {
    return std::make_shared<const Scene>(mapping_.scene());
  }

  bool hasRestarted() override { return has_restarted_; }

 private:
  Tracked start(const std::shared_ptr<const View>& view) {
    Tracked tracked;
    tracked.state = TrackingState::starting;
    if (!mapping_.begin(view, tracked.reason)) return tracked;
    return tracker_.begin(view, mapping_.scene());
  }

  void addKeyframe() {
    const KeyframeId id = mapping_.add(tracker_.takeKeyframe());
    mapping_.improve(id, false);
    if (!options_.loop.enabled) return;
    const std::optional<Loop> loop = detector_.detect(mapping_.scene(), id);
    if (!loop.has_value()) return;
    mapping_.close(*loop);
    if (options_.loop.adjust_all) mapping_.apply(adjustAll(mapping_.scene(), options_));
  }

  Options options_;
  PlaceIndex places_;
  Relocalizer relocalizer_;
  Mapping mapping_;
  Tracker tracker_;
  LoopDetector detector_;
  Patience patience_;
  bool has_restarted_ = false;
};

}  // namespace

std::unique_ptr<Pipeline> makeSequentialPipeline(const Options& options, const Eye& eye) {
  return std::make_unique<SequentialPipeline>(options, eye);
}

}  // namespace visual
