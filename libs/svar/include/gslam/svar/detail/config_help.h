// What --help prints.
#ifndef GSLAM_SVAR_DETAIL_CONFIG_HELP_H
#define GSLAM_SVAR_DETAIL_CONFIG_HELP_H

#include <gslam/svar/detail/config_parameter.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// The number of characters of UTF-8 text.
inline std::size_t characterCount(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 1 : 0;
  return count;
}

/// Appends words, with line breaks and spaces before each line after the first.
inline void appendWrapped(std::string& out, const std::string& text, std::size_t column,
                          std::size_t indent, std::size_t width) {
  std::size_t begin = 0;
  bool first = true;
  while (begin <= text.size()) {
    std::size_t end = text.find_first_of(" \n", begin);
    if (end == std::string::npos) end = text.size();
    const std::string word = text.substr(begin, end - begin);
    const std::size_t size = characterCount(word);
    if (!first && column + 1 + size > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      out += " ";
      ++column;
    }
    out += word;
    column += size;
    first = false;
    if (end < text.size() && text[end] == '\n') {
      out += "\n" + std::string(indent, ' ');
      column = indent;
      first = true;
    }
    begin = end + 1;
  }
}

/// Groups of lines, each with a name on the left and an explanation on the right.
class HelpTable {
 public:
  explicit HelpTable(std::size_t width) : width_(width < 40 ? 40 : width) {}

  void add(const std::string& group, const std::string& left, const std::string& right) {
    for (Group& one : groups_) {
      if (one.name != group) continue;
      one.lines.emplace_back(left, right);
      return;
    }
    groups_.push_back({group, {{left, right}}});
  }

  std::string text() const {
    const std::size_t column = rightColumn();
    std::string out;
    for (const Group& group : groups_) {
      out += "\n" + group.name + ":\n";
      for (const std::pair<std::string, std::string>& line : group.lines) {
        out += "  " + line.first;
        if (line.second.empty()) {
          out += "\n";
          continue;
        }
        std::size_t at = 2 + characterCount(line.first);
        if (at + 2 > column) {  // too long: the explanation begins on the next line
          out += "\n";
          at = 0;
        }
        out += std::string(column - at, ' ');
        appendWrapped(out, line.second, column, column, width_);
        out += "\n";
      }
    }
    return out;
  }

 private:
  struct Group {
    std::string name;
    std::vector<std::pair<std::string, std::string>> lines;
  };

  std::size_t rightColumn() const {
    std::size_t column = 0;
    const std::size_t most = width_ * 2 / 5;
    for (const Group& group : groups_) {
      for (const std::pair<std::string, std::string>& line : group.lines) {
        const std::size_t needed = characterCount(line.first) + 4;
        if (needed <= most && needed > column) column = needed;
      }
    }
    return column != 0 ? column : most;
  }

  std::size_t width_;
  std::vector<Group> groups_;
};

/// "-f, --fps DOUBLE", "--realtime, --no-realtime", "--slam VALUE, --slam.NAME VALUE"
inline std::string parameterUsage(const Parameter& parameter) {
  std::string text = parameter.short_name.empty() ? "" : "-" + parameter.short_name + ", ";
  text += "--" + parameter.name;
  if (parameter.is_bool) return text + ", --no-" + parameter.name;
  text += " " + parameter.placeholder;
  return parameter.is_open ? text + ", --" + parameter.name + ".NAME VALUE" : text;
}

/// Whether it is a null, or an array or object with nothing in it.
inline bool isEmpty(const Svar& value) {
  return value.isNull() || (value.type() >= SvarType::array && value.size() == 0);
}

/// "frames a second (1 to 120; default 30; now 25 from GSLAM_FPS)"
inline std::string parameterHelp(const Parameter& parameter, const Svar& tree,
                                 const std::string& origin) {
  const Svar* const now = SvarParts::find(tree, parameter.name);
  std::string facts = parameter.rule->limits();
  const auto add = [&facts](const std::string& fact) {
    facts += (facts.empty() ? "" : "; ") + fact;
  };
  if (parameter.is_required) {
    add("required");
  } else if (!isEmpty(parameter.default_value)) {
    add("default " + textOfValue(parameter.default_value));
  }
  if (now != nullptr &&
      (parameter.is_required || !SvarParts::same(*now, parameter.default_value))) {
    add("now " + textOfValue(*now) + " from " + origin);
  }
  if (facts.empty()) return parameter.help;
  return parameter.help + (parameter.help.empty() ? "(" : " (") + facts + ")";
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_CONFIG_HELP_H
