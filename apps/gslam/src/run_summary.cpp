#include <gslam/evaluation/statistics.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "run_metrics.h"

namespace app {
namespace {

using gslam::Svar;
using gslam::SvarType;

bool isNumber(const Svar& value) {
  return value.is<double>() && value.type() != SvarType::boolean;
}

Svar describeNumbers(const std::vector<double>& values) {
  const gslam::Statistics s = gslam::statisticsOf(values);
  return Svar::object({{"mean", s.mean},
                       {"median", s.median},
                       {"std", s.std},
                       {"min", s.min},
                       {"max", s.max},
                       {"count", s.count}});
}

// What runs have in common, with statistics in place of numbers; null where there is no such thing.
// Of lists of numbers, such as a rotation, a mean would mean nothing.
Svar summed(const std::vector<Svar>& values) {
  const auto has = [](SvarType type) {
    return [type](const Svar& value) { return value.type() == type; };
  };
  std::vector<double> numbers;
  for (const Svar& value : values) {
    if (isNumber(value)) numbers.push_back(value.as<double>());
  }
  if (!numbers.empty()) return describeNumbers(numbers);
  const auto object = std::find_if(values.begin(), values.end(), has(SvarType::object));
  if (object != values.end()) {
    Svar result = Svar::object();
    for (const Svar::Member& member : object->members()) {
      std::vector<Svar> parts;
      for (const Svar& value : values) {
        if (value.type() != SvarType::object) continue;
        for (const Svar::Member& other : value.members()) {
          if (other.first == member.first) parts.push_back(other.second);
        }
      }
      result.set(member.first, summed(parts));
    }
    return result;
  }
  const auto array = std::find_if(values.begin(), values.end(), has(SvarType::array));
  if (array != values.end()) {
    Svar result = Svar::array();
    for (std::size_t i = 0; i < array->size(); ++i) {
      if (isNumber((*array)[i])) return nullptr;
      std::vector<Svar> parts;
      for (const Svar& value : values) {
        if (value.type() == SvarType::array && i < value.size()) parts.push_back(value[i]);
      }
      result.push_back(summed(parts));
    }
    return result;
  }
  return values.empty() ? Svar() : values.front();
}

bool hasEnd(const Svar& metrics, const char* end) {
  return metrics.get<std::string>("protocol.run.result.end", "") == end;
}

// What a run is in the summary with. A failed one counts with what it reached, so that to crash is
// not better than to lose track; one that was stopped says nothing.
std::vector<Svar> figuresOf(const std::vector<Svar>& metrics) {
  const auto hasScore = [](const Svar& run) {
    return !run.get<Svar>("score.value", Svar()).isNull();
  };
  const bool has_score = std::any_of(metrics.begin(), metrics.end(), hasScore);
  std::vector<Svar> result;
  for (const Svar& run : metrics) {
    if (hasEnd(run, "stopped")) continue;
    Svar figures = Svar::object();
    for (const Svar::Member& member : run.members()) {
      if (member.first != "protocol") figures.set(member.first, member.second);
    }
    if (has_score && !hasScore(run)) figures.set("score", Svar::object({{"value", 0.0}}));
    result.push_back(figures);
  }
  return result;
}

std::string figureText(const Svar& summary, const std::string& path) {
  const Svar found = summary.get<Svar>(path, Svar());
  if (found.isNull() || found.type() != SvarType::object) return "none";
  std::ostringstream out;
  out << found.get<double>("median") << "   (mean " << found.get<double>("mean") << ", std "
      << found.get<double>("std") << ", " << found.get<double>("min") << " to "
      << found.get<double>("max") << ')';
  return out.str();
}

}  // namespace

Svar summaryOf(const std::vector<Svar>& metrics) {
  std::size_t finished = 0;
  Svar others = Svar::array();
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    if (hasEnd(metrics[i], "finished")) {
      ++finished;
    } else {
      const Svar result = metrics[i].get<Svar>("protocol.run.result", Svar::object());
      others.push_back(Svar::object({{"run", i + 1},
                                     {"end", result.get<Svar>("end", Svar())},
                                     {"cause", result.get<Svar>("cause", Svar())},
                                     {"failure", result.get<Svar>("failure", Svar())}}));
    }
  }
  Svar result = Svar::object();
  result.set("protocol", metrics.front().get<Svar>("protocol", Svar()));
  result.set("runs", Svar::object({{"count", metrics.size()},
                                   {"finished", finished},
                                   {"failed", metrics.size() - finished},
                                   {"failures", others}}));
  result.set("coverage", nullptr);
  result.set("score", nullptr);
  const Svar figures = summed(figuresOf(metrics));
  if (figures.isNull()) return result;
  for (const Svar::Member& member : figures.members()) result.set(member.first, member.second);
  return result;
}

std::string summaryText(const Svar& summary) {
  std::ostringstream out;
  out << "runs         " << summary.get<std::size_t>("runs.count") << ", of which "
      << summary.get<std::size_t>("runs.failed")
      << " did not finish: these count with what they reached, or if they were stopped not "
         "at all\n";
  const std::pair<const char*, const char*> kFigures[] = {
      {"coverage     part of frames      ", "coverage.frames"},
      {"APE          translation rmse, m ", "ape.translation.rmse"},
      {"score        0 to 1              ", "score.value"},
      {"time         ms a frame, median  ", "cost.frame_ms.median"},
      {"memory       peak MB             ", "cost.peak_rss_mb"},
      {"CPU          % of a core         ", "cost.cpu_percent"}};
  for (const auto& figure : kFigures) {
    out << figure.first << figureText(summary, figure.second) << '\n';
  }
  return out.str();
}

}  // namespace app
