#include <gslam/evaluation/evaluate.h>

#include "format.h"

namespace gslam {
inline namespace v1 {
namespace {

using evaluation::format;

// A table of errors, with the coverage in each line.
class TextTable {
 public:
  TextTable(const Coverage& coverage, std::string& out)
      : covered_(format("%5.1f %%", 100 * coverage.time)), out_(out) {
    out_ += format("\n%-24s %-5s %10s %10s %10s %10s %10s %8s %8s\n", "error", "unit", "rmse",
                   "mean", "median", "std", "max", "count", "coverage");
  }

  void add(const std::string& name, const char* unit, const Statistics& s) {
    if (s.count == 0) {
      out_ += format("%-24s %-5s none: the way is too short\n", name.c_str(), unit);
      return;
    }
    out_ += format("%-24s %-5s %10.6g %10.6g %10.6g %10.6g %10.6g %8zu %8s\n", name.c_str(), unit,
                   s.rmse, s.mean, s.median, s.std, s.max, s.count, covered_.c_str());
  }

  // One number.
  void add(const std::string& name, const std::string& value) {
    out_ += format("%-24s %s   (coverage %s)\n", name.c_str(), value.c_str(), covered_.c_str());
  }

  std::string& out() { return out_; }

 private:
  std::string covered_;
  std::string& out_;
};

void printAssociation(const Evaluation& e, std::string& out) {
  const PosePairs& p = e.pairs;
  out +=
      format("association  %s: %zu pairs, dropped %zu of the reference and %zu of the estimate\n",
             associationMethodName(e.options.association.method), p.size(), p.dropped_reference,
             p.dropped_estimate);
  if (p.is_numbered) {
    out += format("             by numbers of frames; largest gap %lld frames\n",
                  static_cast<long long>(p.max_gap));
    return;
  }
  out += format("             largest gap %.6g s, at most %.6g s apart", 1e-9 * double(p.max_gap),
                1e-9 * double(p.max_apart));
  if (p.time_offset != 0) out += format(", time offset %.9g s", 1e-9 * double(p.time_offset));
  if (e.options.association.finds_offset) out += format(" (r = %.3f)", p.offset_correlation);
  out += '\n';
}

void printCoverage(const Coverage& c, std::string& out) {
  const char* const unit = c.is_numbered ? "frames" : "s";
  out += format("coverage     %.1f %% of the time, %.1f %% of the frames (%zu of %zu)\n",
                100 * c.time, 100 * c.frames, c.tracked_frames, c.total_frames);
  out += format("             %zu losses, longest %.6g %s; ", c.losses, c.longest_loss, unit);
  out += c.is_initialised ? format("initialised after %.6g %s\n", c.time_to_initialise, unit)
                          : "never initialised\n";
}

void printAlignment(const Evaluation& e, std::string& out) {
  out += "alignment    " + alignmentText(e.options.alignment);
  if (!e.alignment.is_valid) {
    out += " refused: " + e.alignment.reason + '\n';
    return;
  }
  const SIM3d& s = e.alignment.S_world_map;
  const Vec3d t = s.translation();
  out += format(": scale %.9g, rotation %.6g deg, translation %.6g %.6g %.6g m\n", s.scale(),
                57.295779513082323 * s.rotation().angle(), t[0], t[1], t[2]);
  if (e.alignment.is_mirrored) {
    out += "             a mirrored estimate would fit better: is one of its axes turned round?\n";
  }
}

void printErrors(const Evaluation& e, TextTable& table) {
  if (e.has_ape) {
    table.add("APE translation", "m", e.ape.translation);
    table.add("APE rotation", "deg", e.ape.rotation_deg);
    table.add("APE full", "", e.ape.full);
  }
  for (const RelativeErrors& rpe : e.rpe) {
    const std::string name = "RPE " + rpeText(rpe.options);
    table.add(name + " translation", "m", rpe.statistics.translation);
    table.add(name + " rotation", "deg", rpe.statistics.rotation_deg);
  }
  for (const SegmentErrors& segment : e.segments) {
    const std::string name = format("segments %g m ", segment.length);
    table.add(name + "trans.", "%", segment.translation_percent);
    table.add(name + "rot.", "deg/m", segment.rotation_deg_per_m);
  }
}

void printBins(const std::vector<KittiBin>& bins, const char* unit, std::string& out) {
  for (const KittiBin& bin : bins) {
    out += format("  %6g %-4s %10.4f %% %12.6f deg/m %8zu\n", bin.at, unit, bin.t_err_percent,
                  bin.r_err_deg_per_m, bin.count);
  }
}

void printKitti(const KittiErrors& kitti, TextTable& table) {
  if (kitti.count == 0) {
    table.out() += "KITTI                    none: " + kitti.reason + '\n';
    return;
  }
  table.add("KITTI", format("t_err %.4f %%, r_err %.6f deg/m, %zu segments", kitti.t_err_percent,
                            kitti.r_err_deg_per_m, kitti.count));
  printBins(kitti.lengths, "m", table.out());
  printBins(kitti.speeds, "m/s", table.out());
}

void printSummary(const Evaluation& e, TextTable& table) {
  if (e.options.has_kitti && e.has_relative) printKitti(e.kitti, table);
  if (e.has_relative && e.drift.length > 0) {
    table.add("drift", format("%.4f %%, %.6f deg/m over %.6g m", e.drift.translation_percent,
                              e.drift.rotation_deg_per_m, e.drift.length));
  }
  if (e.has_nees) {
    table.add("NEES", e.nees.reason.empty() ? format("%.4g, expected %.4g to %.4g", e.nees.mean,
                                                     e.nees.least_mean, e.nees.most_mean)
                                            : "none: " + e.nees.reason);
  }
  if (e.has_cloud) {
    const CloudErrors& c = e.cloud;
    table.add("cloud", "m", c.distance);
    table.add("cloud", format("accuracy %.1f %%, completeness %.1f %%, %zu outliers",
                              100 * c.accuracy, 100 * c.completeness, c.outliers));
  }
  if (!e.score.is_valid) {
    table.out() += "score                    none: " + e.score.reason + '\n';
    return;
  }
  table.add("score", format("%.4f of 1, over %zu parts of %.4g m", e.score.value, e.score.parts,
                            e.score.length));
}

}  // namespace

std::string evaluationText(const Evaluation& evaluation) {
  std::string out;
  printAssociation(evaluation, out);
  printCoverage(evaluation.coverage, out);
  printAlignment(evaluation, out);
  TextTable table(evaluation.coverage, out);
  printErrors(evaluation, table);
  printSummary(evaluation, table);
  return out;
}

}  // namespace v1
}  // namespace gslam
