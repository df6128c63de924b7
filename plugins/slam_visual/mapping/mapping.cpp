#include "mapping/mapping.h"

#include <gslam/base/log.h>

#include <string>
#include <vector>

namespace visual {

using gslam::KeyframeId;

Mapping::Mapping(const Options& options, const Eye& eye, PlaceIndex& places)
    : options_(options), places_(places), world_(eye), initializer_(options), mapper_(options) {}

bool Mapping::begin(const std::shared_ptr<const View>& view, std::string& reason) {
  if (!initializer_.begin(view, world_, reason)) return false;
  mapper_.begin(world_);
  for (const auto& item : world_.map().keyframes()) {
    places_.add(item.id, world_.scene().of(item.id).view);
  }
  return true;
}

void Mapping::reset() {
  for (const auto& item : world_.map().keyframes()) places_.remove(item.id);
  world_ = World(world_.eye());
  initializer_.reset();
  mapper_ = LocalMapper(options_);
}

KeyframeId Mapping::add(const KeyframeRequest& request) {
  return mapper_.add(world_, request);
}

void Mapping::improve(KeyframeId id, bool is_hurried) {
  if (is_hurried) {
    mapper_.improveLittle(world_, id);
  } else {
    std::vector<KeyframeId> removed;
    mapper_.improve(world_, id, removed);
    for (const KeyframeId gone : removed) places_.remove(gone);
  }
  places_.add(id, world_.scene().of(id).view);
}

void Mapping::close(const Loop& loop) {
  const LoopReport report = closeLoop(world_, loop, options_);
  const std::string loop_text = "keyframe " + std::to_string(std::uint32_t(loop.here)) + " to " +
                                std::to_string(std::uint32_t(loop.there));
  if (!report.is_closed) {
    GSLAM_LOG(warning) << "loop from " << loop_text << " left open: " << report.optimizer;
    return;
  }
  GSLAM_LOG(info) << "loop closed from " << loop_text << ": " << report.merged
                  << " points merged, moved by " << report.moved << " m, " << report.optimizer;
}

void Mapping::apply(const AdjustedScene& adjusted) {
  visual::apply(adjusted, world_);
}

}  // namespace visual
