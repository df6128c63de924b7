#ifndef GSLAM_OPTIMIZER_SRC_FILES_POSE_GRAPH_TEXT_H
#define GSLAM_OPTIMIZER_SRC_FILES_POSE_GRAPH_TEXT_H

#include <gslam/optimizer/files/any_pose_graph.h>
#include <gslam/optimizer/initialize_poses.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/text_reader.h"
#include "files/text_writer.h"

// What the formats of pose graphs have in common: lines of vertices and edges. How they look is
// said by a Dialect:
//
//     using Group = SE2d, SE3d or SIM3d;
//     static bool isVertex(std::string_view tag), isEdge(std::string_view tag);
//     static constexpr const char *kVertex, *kEdge;    // tags that are written
//     static constexpr bool kHasFix;                   // whether there are lines FIX
//     static Group readPose(TextReader& in);
//     static Jacobian readInformation(TextReader& in);
//     static void writePose(const Group& pose, TextWriter& out);
//     static void writeInformation(const Jacobian& information, TextWriter& out);

namespace gslam {
inline namespace v1 {
namespace detail {

// Vertices and edges by ids, as they stand in the file.
template <class Group>
struct PoseGraphLines {
  struct Edge {
    std::int64_t from, to;
    const char* place;
  };
  IdMap ids;
  PoseGraph<Group> graph;  // without from and to
  std::vector<Edge> edges;
  std::vector<std::pair<std::int64_t, const char*>> fixed;
};

// The upper triangle of an N x N matrix, row by row.
template <std::size_t N>
Mat<double, N, N> readUpperTriangle(TextReader& in) {
  Mat<double, N, N> m{};
  for (std::size_t r = 0; r < N; ++r) {
    for (std::size_t c = r; c < N; ++c)
      m(r, c) = m(c, r) = in.number("an element of an information");
  }
  return m;
}
template <std::size_t N>
void writeUpperTriangle(const Mat<double, N, N>& m, TextWriter& out) {
  for (std::size_t r = 0; r < N; ++r) {
    for (std::size_t c = r; c < N; ++c) out << ' ' << m(r, c);
  }
}

// What shows that numbers stand in another order, without a decomposition: a negative diagonal, or
// more beside it than the diagonal allows.
template <std::size_t N>
bool mayBeInformation(const Mat<double, N, N>& m) {
  constexpr double kRounding = 1 + 1e-6;
  for (std::size_t r = 0; r < N; ++r) {
    if (!(m(r, r) >= 0)) return false;
    for (std::size_t c = 0; c < r; ++c) {
      const double most = std::sqrt(m(r, r)) * std::sqrt(m(c, c));
      if (!(std::fabs(m(r, c)) <= most * kRounding)) return false;
    }
  }
  return true;
}

template <class Dialect>
void readVertex(TextReader& in, PoseGraphLines<typename Dialect::Group>& lines) {
  const char* const begin = in.hasWord() ? in.place() : nullptr;
  const std::size_t count = lines.ids.size();
  if (lines.ids.add(in.integer("a vertex' id")) < count) {
    in.failAt(begin, "is a vertex that is there already");
  }
  lines.graph.T_world_body.push_back(Dialect::readPose(in));
}

template <class Dialect>
void readEdge(TextReader& in, PoseGraphLines<typename Dialect::Group>& lines) {
  const char* const begin = in.hasWord() ? in.place() : nullptr;
  const std::int64_t from = in.integer("a vertex' id"), to = in.integer("a vertex' id");
  if (from == to) in.failAt(begin, "is joined to itself, expected two vertices");
  lines.edges.push_back({from, to, begin});
  lines.graph.T_from_to.push_back(Dialect::readPose(in));
  const char* const information = in.hasWord() ? in.place() : nullptr;
  lines.graph.information.push_back(Dialect::readInformation(in));
  if (mayBeInformation(lines.graph.information.back())) return;
  in.failAt(information, "begins an information that is not positive semi-definite");
}

template <class Dialect>
bool readFix(TextReader& in, PoseGraphLines<typename Dialect::Group>& lines) {
  while (in.hasWord()) {
    const char* const begin = in.place();
    lines.fixed.emplace_back(in.integer("a vertex' id"), begin);
  }
  return true;
}

template <class Dialect>
PoseGraphLines<typename Dialect::Group> readGraphLines(TextReader& in, const char* supported) {
  PoseGraphLines<typename Dialect::Group> lines;
  for (; in.hasLine(); in.expectLineEnd()) {
    const std::string_view tag = in.word("a tag");
    const bool is_vertex = Dialect::isVertex(tag), is_edge = Dialect::isEdge(tag);
    const bool is_fix = Dialect::kHasFix && tag == "FIX";
    if (!is_vertex && !is_edge && !is_fix) {
      in.fail(std::string("is not supported here, expected ") + supported +
              ", all of one kind in a file");
    }
    in.skipWord();
    if (is_vertex) readVertex<Dialect>(in, lines);
    if (is_edge) readEdge<Dialect>(in, lines);
    if (is_fix) readFix<Dialect>(in, lines);
  }
  return lines;
}

// Where the file has edges alone: their ends, in the order of their ids.
template <class Group>
void addVerticesOfEdges(PoseGraphLines<Group>& lines) {
  std::vector<std::int64_t> ids;
  for (const auto& edge : lines.edges) ids.insert(ids.end(), {edge.from, edge.to});
  std::sort(ids.begin(), ids.end());
  for (const std::int64_t id : ids) lines.ids.add(id);
  lines.graph.T_world_body.resize(lines.ids.size());
}

template <class Group>
PoseGraph<Group> graphOfLines(const TextReader& in, PoseGraphLines<Group>&& lines) {
  const bool has_vertices = !lines.ids.empty();
  if (!has_vertices) addVerticesOfEdges(lines);
  if (lines.ids.empty()) throw ParseError(in.name(), 0, 0, "has neither a vertex nor an edge");
  PoseGraph<Group> graph = std::move(lines.graph);
  const auto indexOf = [&](std::int64_t id, const char* place) {
    const std::uint32_t index = lines.ids.indexOf(id);
    if (index == IdMap::kNone) {
      in.throwAt(place, "vertex " + std::to_string(id) + " is not in the file");
    }
    return index;
  };
  for (const auto& edge : lines.edges) {
    graph.from.push_back(indexOf(edge.from, edge.place));
    graph.to.push_back(indexOf(edge.to, edge.place));
  }
  if (!lines.fixed.empty()) graph.pose_fixed.assign(lines.ids.size(), 0);
  for (const auto& fixed : lines.fixed) graph.pose_fixed[indexOf(fixed.first, fixed.second)] = 1;
  graph.ids = std::move(lines.ids);
  if (has_vertices) return graph;
  try {
    initializePoses(graph.problem());
  } catch (const ArgumentError& error) {
    throw ParseError(in.name(), 0, 0,
                     std::string("poses cannot be made of edges: ") + error.what());
  }
  return graph;
}

// Whether the first line that says of which kind a file is, is of this one.
template <class Dialect>
bool isOfDialect(TextReader in) {
  for (; in.hasLine(); in.skipLine()) {
    const std::string_view tag = in.word("a tag");
    if (Dialect::isVertex(tag) || Dialect::isEdge(tag)) return true;
    if (!Dialect::kHasFix || tag != "FIX") return false;
  }
  return false;
}

template <class Dialect>
AnyPoseGraph readGraph(TextReader& in, const char* supported) {
  return graphOfLines(in, readGraphLines<Dialect>(in, supported));
}

// The dialect whose first line this is; the last one where there is none.
template <class Dialect, class... Others>
AnyPoseGraph readGraphOf(TextReader& in, const char* supported) {
  if constexpr (sizeof...(Others) > 0) {
    if (!isOfDialect<Dialect>(in)) return readGraphOf<Others...>(in, supported);
  }
  TextReader look = in;
  if (!look.hasLine()) look.failEnd(supported);
  return readGraph<Dialect>(in, supported);
}

template <class Group>
void checkGraphArrays(const PoseGraph<Group>& graph, const char* format) {
  const std::size_t n = graph.T_from_to.size(), poses = graph.T_world_body.size();
  const auto expect = [](const char* field, std::size_t size, std::size_t expected, bool empty) {
    if (size == expected || (empty && size == 0)) return;
    throw ArgumentError(
        field, "has " + std::to_string(size) + " elements, expected " + std::to_string(expected));
  };
  expect("from", graph.from.size(), n, false);
  expect("to", graph.to.size(), n, false);
  expect("information", graph.information.size(), n, true);
  expect("pose_fixed", graph.pose_fixed.size(), poses, true);
  expect("ids", graph.ids.size(), poses, true);
  for (std::size_t i = 0; i < n; ++i) {
    if (graph.from[i] < poses && graph.to[i] < poses) continue;
    throw ArgumentError("edge " + std::to_string(i),
                        "has an end that is no pose, expected below " + std::to_string(poses));
  }
  if (graph.prior_pose.empty()) return;
  throw ArgumentError("prior_pose", std::string("is not empty: ") + format + " cannot hold priors");
}

template <class Dialect>
void writeGraph(const PoseGraph<typename Dialect::Group>& graph, TextWriter& out) {
  const auto idOf = [&graph](std::uint32_t index) {
    return graph.ids.empty() ? std::int64_t(index) : graph.ids.idOf(index);
  };
  for (std::size_t i = 0; i < graph.T_world_body.size(); ++i) {
    out << Dialect::kVertex << ' ' << idOf(static_cast<std::uint32_t>(i));
    Dialect::writePose(graph.T_world_body[i], out);
    out << '\n';
  }
  for (std::size_t i = 0; Dialect::kHasFix && i < graph.pose_fixed.size(); ++i) {
    if (graph.pose_fixed[i] != 0) out << "FIX " << idOf(static_cast<std::uint32_t>(i)) << '\n';
  }
  const auto identity = Dialect::Group::Jacobian::identity();
  for (std::size_t i = 0; i < graph.from.size(); ++i) {
    out << Dialect::kEdge << ' ' << idOf(graph.from[i]) << ' ' << idOf(graph.to[i]);
    Dialect::writePose(graph.T_from_to[i], out);
    Dialect::writeInformation(graph.information.empty() ? identity : graph.information[i], out);
    out << '\n';
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FILES_POSE_GRAPH_TEXT_H
