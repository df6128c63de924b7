// A script by which bash completes the arguments of a program.
#ifndef GSLAM_SVAR_DETAIL_BASH_COMPLETION_H
#define GSLAM_SVAR_DETAIL_BASH_COMPLETION_H

#include <gslam/svar/detail/config_parameter.h>

#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

/// A word that bash takes as it is.
inline std::string quotedForBash(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted.push_back(c);
    }
  }
  return quoted + "'";
}

/// The words that a parameter's value can be, in one list with line ends; nothing where any can.
inline std::string choicesForBash(const Parameter& parameter) {
  std::string list;
  for (const Svar& choice : parameter.rule->choices()) {
    const bool text = choice.type() == SvarType::string;
    list += (text ? choice.as<std::string>() : textOfValue(choice)) + "\n";
  }
  return list;
}

inline std::string bashCompletionScript(const std::string& program, const Parameters& parameters) {
  std::string names = "--help\n--config\n--dump-config\n--bash-completion\n";
  std::string cases;
  for (const std::unique_ptr<Parameter>& one : parameters) {
    names += "--" + one->name + "\n";
    if (one->is_bool) names += "--no-" + one->name + "\n";
    const std::string choices = choicesForBash(*one);
    if (choices.empty()) continue;
    const std::string& letter = one->short_name;
    cases += "    --" + one->name + (letter.empty() ? "" : "|-" + letter) +
             ") words=" + quotedForBash(choices) + " ;;\n";
  }
  std::string function = "_";
  for (const char c : program) function.push_back(isLetter(c) || isDigit(c) ? c : '_');
  return "# Completion for bash: source this file, or put it into\n"
         "# ~/.local/share/bash-completion/completions/\n" +
         function +
         "_complete() {\n"
         "  local word=\"${COMP_WORDS[COMP_CWORD]}\" name=\"${COMP_WORDS[COMP_CWORD-1]}\" words=\n"
         "  # bash takes --name=value for three words\n"
         "  if [[ $word == = ]]; then word=; name=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
         "  elif [[ $name == = ]]; then name=\"${COMP_WORDS[COMP_CWORD-2]}\"; fi\n"
         "  case \"$name\" in\n" +
         cases +
         "  esac\n"
         "  if [[ -z $words && $word == -* ]]; then\n"
         "    words=" +
         quotedForBash(names) +
         "\n"
         "  fi\n"
         "  COMPREPLY=()\n"
         "  if [[ -z $words ]]; then mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); return; "
         "fi\n"
         "  local one\n"
         "  while IFS= read -r one; do\n"
         "    if [[ -n $one && $one == \"$word\"* ]]; then COMPREPLY+=(\"$one\"); fi\n"
         "  done <<< \"$words\"\n"
         "}\n"
         "complete -o filenames -F " +
         function + "_complete " + quotedForBash(program) + "\n";
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_BASH_COMPLETION_H
