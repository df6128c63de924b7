#include <gslam/core/version.h>
#include <gslam/evaluation/evaluate.h>
#include <gslam/evaluation/version.h>

namespace gslam {
inline namespace v1 {
namespace {

Svar describe(const Statistics& s) {
  const bool is_any = s.count > 0;
  const auto value = [is_any](double number) { return is_any ? Svar(number) : Svar(); };
  return Svar::object({{"rmse", value(s.rmse)},
                       {"mean", value(s.mean)},
                       {"median", value(s.median)},
                       {"std", value(s.std)},
                       {"min", value(s.min)},
                       {"max", value(s.max)},
                       {"sse", value(s.sse)},
                       {"count", s.count},
                       {"p90", value(s.p90)},
                       {"p95", value(s.p95)},
                       {"p99", value(s.p99)}});
}

Svar describe(const PoseErrorStatistics& errors) {
  return Svar::object({{"translation", describe(errors.translation)},
                       {"rotation_deg", describe(errors.rotation_deg)},
                       {"full", describe(errors.full)}});
}

Svar describe(const PosePairs& pairs) {
  // Numbers of frames are no times.
  Svar result = Svar::object({{"pairs", pairs.size()},
                              {"dropped_ref", pairs.dropped_reference},
                              {"dropped_est", pairs.dropped_estimate}});
  if (pairs.is_numbered) {
    result.set("max_gap_s", nullptr);
    result.set("max_gap_frames", pairs.max_gap);
    return result;
  }
  result.set("max_gap_s", 1e-9 * double(pairs.max_gap));
  result.set("max_dt_s", 1e-9 * double(pairs.max_apart));
  result.set("time_offset_s", 1e-9 * double(pairs.time_offset));
  return result;
}

Svar describe(const Coverage& c) {
  const std::string unit = c.is_numbered ? "_frames" : "_s";
  Svar result = Svar::object({{"time", c.time},
                              {"frames", c.frames},
                              {"tracked_frames", c.tracked_frames},
                              {"total_frames", c.total_frames},
                              {"losses", c.losses},
                              {"longest_loss" + unit, c.longest_loss}});
  result.set("time_to_initialise" + unit, c.is_initialised ? Svar(c.time_to_initialise) : Svar());
  if (c.lost_after > 0) result.set("lost_after_s", c.lost_after);
  return result;
}

Svar describe(const Alignment& alignment) {
  if (!alignment.is_valid) {
    return Svar::object({{"scale", nullptr},
                         {"rotation", nullptr},
                         {"translation", nullptr},
                         {"reason", alignment.reason}});
  }
  const SIM3d& s = alignment.S_world_map;
  const SO3d& q = s.rotation();
  const Vec3d t = s.translation();
  return Svar::object({{"scale", s.scale()},
                       {"rotation", Svar::array({q.x(), q.y(), q.z(), q.w()})},
                       {"translation", Svar::array({t[0], t[1], t[2]})},
                       {"mirrored", alignment.is_mirrored}});
}

Svar describe(const std::vector<KittiBin>& bins, const char* key) {
  Svar result = Svar::array();
  for (const KittiBin& bin : bins) {
    result.push_back(Svar::object({{key, bin.at},
                                   {"count", bin.count},
                                   {"t_err_percent", bin.t_err_percent},
                                   {"r_err_deg_per_m", bin.r_err_deg_per_m}}));
  }
  return result;
}

Svar describe(const KittiErrors& kitti) {
  const bool is_any = kitti.count > 0;
  Svar result = Svar::object({{"t_err_percent", is_any ? Svar(kitti.t_err_percent) : Svar()},
                              {"r_err_deg_per_m", is_any ? Svar(kitti.r_err_deg_per_m) : Svar()},
                              {"count", kitti.count},
                              {"segments", describe(kitti.lengths, "length_m")},
                              {"speeds", describe(kitti.speeds, "speed_mps")}});
  if (!is_any) result.set("reason", kitti.reason);
  return result;
}

Svar describe(const SegmentErrors& segment) {
  return Svar::object({{"length_m", segment.length},
                       {"translation", describe(segment.translation)},
                       {"translation_percent", describe(segment.translation_percent)},
                       {"rotation_deg", describe(segment.rotation_deg)},
                       {"rotation_deg_per_m", describe(segment.rotation_deg_per_m)},
                       {"yaw_deg", describe(segment.yaw_deg)},
                       {"gravity_deg", describe(segment.gravity_deg)}});
}

Svar describe(const Drift& drift) {
  const bool moves = drift.length > 0;
  return Svar::object({{"length_m", drift.length},
                       {"translation_percent", moves ? Svar(drift.translation_percent) : Svar()},
                       {"rotation_deg_per_m", moves ? Svar(drift.rotation_deg_per_m) : Svar()}});
}

Svar describe(const Score& score) {
  Svar result = Svar::object({{"value", score.is_valid ? Svar(score.value) : Svar()},
                              {"length_m", score.length},
                              {"parts", score.parts}});
  if (!score.is_valid) {
    result.set("reason", score.reason);
    return result;
  }
  Svar levels = Svar::array();
  for (const ScoreLevel& level : score.levels) {
    levels.push_back(Svar::object({{"threshold_percent", 100 * level.threshold},
                                   {"fraction", level.fraction},
                                   {"scale", level.scale}}));
  }
  result.set("levels", levels);
  return result;
}

Svar describe(const Nees& nees) {
  const bool is_any = nees.reason.empty();
  Svar result = Svar::object({{"mean", is_any ? Svar(nees.mean) : Svar()},
                              {"freedom", 6},
                              {"count", nees.values.size()},
                              {"singular", nees.singular}});
  if (!is_any) {
    result.set("reason", nees.reason);
    return result;
  }
  result.set("mean_95", Svar::array({nees.least_mean, nees.most_mean}));
  result.set("inside_95_percent", nees.inside_percent);
  return result;
}

Svar describe(const CloudErrors& cloud) {
  Svar result = Svar::object({{"distance", describe(cloud.distance)},
                              {"outliers", cloud.outliers},
                              {"accuracy", cloud.accuracy},
                              {"completeness", cloud.completeness},
                              {"f_score", cloud.f_score},
                              {"scale", cloud.S_world_cloud.scale()},
                              {"icp_rounds", cloud.icp_rounds}});
  if (!cloud.reason.empty()) result.set("reason", cloud.reason);
  return result;
}

Svar describeProtocol(const Evaluation& evaluation) {
  const EvaluationOptions& options = evaluation.options;
  const AssociationOptions& association = options.association;
  Svar how = Svar::object({{"method", associationMethodName(association.method)}});
  how.set("by", association.is_numbered ? "number of frame" : "time");
  if (!association.is_numbered) {
    how.set("max_dt_s", 1e-9 * double(association.max_dt));
    how.set("time_offset", association.finds_offset ? "auto" : "given");
    if (association.finds_offset) {
      how.set("correlation", evaluation.pairs.offset_correlation);
    }
  }
  Svar result =
      options.protocol.type() == SvarType::object ? options.protocol.clone() : Svar::object();
  result.set("association", how);
  result.set("alignment", alignmentText(options.alignment));
  result.set("coverage", options.frames.empty() ? "time of the reference" : "frames delivered");
  result.set("units", Svar::object({{"translation", "m"},
                                    {"rotation", "quaternion x y z w"},
                                    {"errors of rotation", "deg"},
                                    {"time", "s"}}));
  result.set("versions", Svar::object({{"evaluation", GSLAM_EVALUATION_VERSION},
                                       {"core", GSLAM_CORE_VERSION}}));
  return result;
}

}  // namespace

Svar evaluationToSvar(const Evaluation& evaluation) {
  Svar result = Svar::object({{"protocol", describeProtocol(evaluation)},
                              {"association", describe(evaluation.pairs)},
                              {"coverage", describe(evaluation.coverage)},
                              {"alignment", describe(evaluation.alignment)},
                              {"ape", evaluation.has_ape ? describe(evaluation.ape) : Svar()}});
  Svar rpe = Svar::array();
  for (const RelativeErrors& errors : evaluation.rpe) {
    Svar one = describe(errors.statistics);
    Svar named = Svar::object({{"delta", rpeText(errors.options)}});
    for (const Svar::Member& member : one.members()) named.set(member.first, member.second);
    rpe.push_back(named);
  }
  result.set("rpe", rpe);
  if (evaluation.options.has_kitti) {
    result.set("kitti", evaluation.has_relative ? describe(evaluation.kitti) : Svar());
  }
  Svar segments = Svar::array();
  for (const SegmentErrors& segment : evaluation.segments) segments.push_back(describe(segment));
  if (segments.size() > 0) result.set("segments", segments);
  result.set("drift", evaluation.has_relative ? describe(evaluation.drift) : Svar());
  result.set("score", describe(evaluation.score));
  if (evaluation.has_nees) result.set("nees", describe(evaluation.nees));
  if (evaluation.has_cloud) result.set("cloud", describe(evaluation.cloud));
  return result;
}

}  // namespace v1
}  // namespace gslam
