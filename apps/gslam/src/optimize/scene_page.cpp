#include "scene_page.h"

#include <gslam/base/detail/new_file.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "scene_script.h"
#include "solver_report.h"

namespace app {
namespace {

using gslam::OptimizerIteration;
using gslam::OptimizerSummary;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// For people; JavaScript reads it, too, and has nothing to draw where it is not finite.
std::string pageNumber(double value, const char* format = "%.6g") {
  if (!std::isfinite(value)) return "0";
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string base64(const std::string& bytes) {
  static const char* const digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const unsigned word = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    text += digits[word >> 18];
    text += digits[word >> 12 & 63];
    text += i + 1 < bytes.size() ? digits[word >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digits[word & 63] : '=';
  }
  return text;
}

void addFloats(const gslam::Vec3f& values, std::string& bytes) {
  for (const float value : values.values) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 255);
  }
}

// A JavaScript object of packed arrays.
std::string packed(const Scene& scene) {
  std::string points, colors, lines, kinds;
  for (const gslam::Vec3f& point : scene.points) addFloats(point, points);
  for (const auto& color : scene.colors) {
    for (const std::uint8_t value : color) colors += static_cast<char>(value);
  }
  for (const auto& line : scene.lines) {
    for (const gslam::Vec3f& end : line) addFloats(end, lines);
  }
  for (const SceneLine kind : scene.kinds) kinds += static_cast<char>(kind);
  return "{points:\"" + base64(points) + "\",colors:\"" + base64(colors) + "\",lines:\"" +
         base64(lines) + "\",kinds:\"" + base64(kinds) + "\"}";
}

std::string viewText(const SceneView& view) {
  std::string text = "{centre:[";
  for (const float value : view.centre.values) text += pageNumber(double(value), "%.9g") + ",";
  text += "],radius:" + pageNumber(double(view.radius), "%.9g") + ",R:[";
  for (const float value : view.R_view_world.values)
    text += pageNumber(double(value), "%.9g") + ",";
  return text + "]}";
}

// The cost of each iteration, its logarithm upwards.
std::string costChart(const OptimizerSummary& summary) {
  std::vector<double> heights;
  for (const OptimizerIteration& step : summary.iterations) {
    if (step.is_successful && step.cost > 0 && std::isfinite(step.cost)) {
      heights.push_back(std::log10(step.cost));
    }
  }
  if (heights.size() < 2) return "";
  const auto range = std::minmax_element(heights.begin(), heights.end());
  const double low = *range.first, high = std::max(*range.second, low + 1e-9);
  std::string points;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double x = 10 + 580 * static_cast<double>(i) / static_cast<double>(heights.size() - 1);
    const double y = 110 - 100 * (heights[i] - low) / (high - low);
    points += pageNumber(x, "%.1f") + "," + pageNumber(y, "%.1f") + " ";
  }
  return "<svg viewBox=\"0 0 600 120\" role=\"img\" aria-label=\"cost by iteration\"><polyline "
         "points=\"" +
         points + "\"/></svg>\n<p class=\"note\">Cost of the steps that were kept, from " +
         pageNumber(std::pow(10, high)) + " down to " + pageNumber(std::pow(10, low)) +
         ", logarithmic.</p>\n";
}

// What the colours of lines mean, of those that are there.
std::string legend(const Scene& scene) {
  static const char* const names[] = {"cameras", "edges from a pose to the next", "other edges"};
  std::string text;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    if (std::count(scene.kinds.begin(), scene.kinds.end(), static_cast<SceneLine>(kind)) == 0) {
      continue;
    }
    text += " <span class=\"kind" + std::to_string(kind) + "\">&#9632;</span> " + names[kind];
  }
  return text;
}

std::string factsTable(const OptimizerSummary& summary) {
  std::string rows;
  const auto add = [&rows](const char* name, const std::string& value) {
    rows += std::string("<tr><th>") + name + "</th><td>" + escaped(value) + "</td></tr>\n";
  };
  add("back end", summary.backend + ", " + summary.linear_solver);
  add("end", std::string(nameOf(summary.status)) + ": " + summary.message);
  add("cost", costsText(summary));
  add("observations", std::to_string(summary.observations) + ", " +
                          std::to_string(summary.left_out) + " left out, " +
                          std::to_string(summary.inliers) + " inliers");
  add("parameters", std::to_string(summary.parameters));
  add("time", pageNumber(summary.times.total, "%.3g") + " s");
  for (const std::string& warning : summary.warnings) add("warning", warning);
  return "<table>\n" + rows + "</table>\n";
}

}  // namespace

void writeScenePage(const ScenePage& page, const std::string& path) {
  const std::string title = escaped(page.title);
  gslam::detail::NewFile file(path);
  const auto write = [&file](const std::string& text) { file.write(text.data(), text.size()); };
  write(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width\">\n<title>" +
      title + "</title>\n<style>\n" + kSceneStyle + "</style>\n</head>\n<body>\n<h1>" + title +
      "</h1>\n");
  write("<div class=\"pair\">\n<figure><canvas></canvas><figcaption>" + escaped(page.start) +
        "</figcaption></figure>\n"
        "<figure><canvas></canvas><figcaption>after</figcaption></figure>\n</div>\n<p "
        "class=\"note\">Drag to turn, with Shift to move, wheel to zoom, double click to begin "
        "anew." +
        legend(page.before) + "</p>\n");
  write(factsTable(page.summary) + costChart(page.summary));
  write("<script>\nconst view0 = " + viewText(page.view) + ";\nconst packed = [" +
        packed(page.before) + ",\n");
  write(packed(page.after) + "];\n" + kSceneScript + "</script>\n</body>\n</html>\n");
  file.commit();
}

}  // namespace app
