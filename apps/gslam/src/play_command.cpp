#include <gslam/datasets/contact_sheet.h>
#include <gslam/datasets/export_dataset.h>
#include <gslam/svar/error.h>
#include <gslam/svar/json.h>

#include <atomic>
#include <iostream>

#include "command.h"
#include "interrupt.h"
#include "progress.h"
#include "session.h"
#include "settings.h"

namespace app {
namespace {

std::string layoutHelp() {
  std::string text = "layout for --save:";
  for (const gslam::ExportFormat& format : gslam::exportFormats()) text += " " + format.name;
  return text;
}

std::vector<std::string> layouts() {
  std::vector<std::string> names;
  for (const gslam::ExportFormat& format : gslam::exportFormats()) names.push_back(format.name);
  return names;
}

gslam::Svar describeExport(const gslam::ExportReport& report) {
  return gslam::Svar::object({{"frames", report.frames},
                              {"files", report.files},
                              {"bytes", report.bytes},
                              {"stopped", report.is_stopped},
                              {"left_out", report.left_out},
                              {"remarks", report.remarks}});
}

void printExport(const gslam::ExportReport& report, const std::string& folder) {
  std::cout << (report.is_stopped ? "stopped: " : "saved: ") << report.frames << " frames, "
            << report.files << " files, " << report.bytes / 1000000 << " MB in " << folder << '\n';
  for (const std::string& thing : report.left_out) std::cout << "left out: " << thing << '\n';
  for (const std::string& remark : report.remarks) std::cout << "note: " << remark << '\n';
}

// Writes the frames as files of another layout.
int save(Session& session, const Options& options, const std::string& folder) {
  std::atomic<bool> stop{false};
  Progress progress;
  gslam::ExportOptions how;
  how.count = session.options().count;
  how.progress = [&progress](std::size_t done, std::size_t total) { progress.show(done, total); };
  how.stop = &stop;
  session.dataset().seek(session.options().first);
  const OnInterrupt interrupt([&stop] { stop = true; });
  const gslam::ExportReport report =
      gslam::exportDataset(session.dataset(), folder, options.get<std::string>("as"), how);
  if (options.isJson()) {
    std::cout << gslam::printJson(describeExport(report)) << '\n';
  } else {
    printExport(report, folder);
  }
  return report.is_stopped ? kInterrupted : kSuccess;
}

int play(Session& session, const Options& options) {
  const OnInterrupt interrupt([&session] { session.stop(); });
  const gslam::RunResult result = session.play();
  const gslam::Svar report = describe(result);
  if (options.isJson()) {
    std::cout << gslam::printJson(report) << '\n';
  } else {
    printResult(report, session.hasSlam());
  }
  std::cout.flush();
  printFailure(report);
  return statusOf(result.play);
}

}  // namespace

int playCommand(const std::vector<std::string>& arguments) {
  Options options("gslam play DATASET [--slam S] [options]",
                  "Plays a dataset, to a SLAM system or to nobody, and says how fast it went; or "
                  "saves it in the layout of a public dataset, or draws some of its frames.");
  Session::declare(options);
  options.arg<std::string>("save", "", "folder to write the dataset to, instead of playing it")
      .group("Save");
  options.arg<std::string>("as", "tum", layoutHelp()).choices(layouts()).group("Save");
  options.arg<std::string>("contact-sheet", "", "PNG file to draw frames in, instead of playing")
      .group("Save");
  if (!options.read(withSettings(arguments))) return kSuccess;
  if (options.get<double>("timeout") != 0 && !options.get<bool>("isolate")) {
    throw gslam::ConfigError("--timeout",
                             "needs --isolate here: a call that hangs cannot be ended "
                             "within one process");
  }
  Session session(options);
  session.findSlam(options);
  session.makeSlam();
  const auto sheet = options.get<std::string>("contact-sheet");
  const auto folder = options.get<std::string>("save");
  if (!sheet.empty()) gslam::writeContactSheet(session.dataset(), sheet);
  if (!folder.empty()) return save(session, options, folder);
  return sheet.empty() ? play(session, options) : kSuccess;
}

}  // namespace app
