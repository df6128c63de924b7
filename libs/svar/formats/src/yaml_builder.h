// From the events of yaml-cpp to values.
#ifndef GSLAM_SVAR_FORMATS_SRC_YAML_BUILDER_H
#define GSLAM_SVAR_FORMATS_SRC_YAML_BUILDER_H

#include <gslam/svar_formats/yaml.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <cstddef>
#include <string>
#include <vector>

#include "yaml_text.h"

namespace gslam {
namespace formats {

/// Takes the events of all documents of a text. Finished values lie on a stack, as in the reader of
/// JSON; depth, number of values and what aliases make of them are counted.
class YamlBuilder : public YAML::EventHandler {
 public:
  /// What it is given must outlive it.
  /// @param one  whether a second document is an error
  YamlBuilder(const YamlText& text, const YamlOptions& options, bool one)
      : text_(text), options_(options), one_(one) {}

  std::vector<Svar>& documents() noexcept { return documents_; }

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override;
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override;
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override;

 private:
  // An array or object whose end was not read yet.
  struct Open {
    std::size_t offset;
    std::string tag;
    YAML::anchor_t anchor;
    std::size_t first_value;   // index of its first value on the stack
    std::size_t first_name;    // and of its first name
    std::size_t count_before;  // of values
    std::size_t height;        // how many arrays and objects stand inside one another in it
    bool is_object;
    bool expects_name;
  };

  struct Name {
    std::string text;
    std::size_t offset;
    bool merges;
  };

  // What aliases stand for.
  struct Anchored {
    Svar value;
    std::string text;  // of a scalar, for names
    std::size_t count = 0;
    std::size_t height = 0;
    bool is_finished = false;
  };

  void onScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value);
  bool expectsName() const { return !open_.empty() && open_.back().expects_name; }
  void addName(std::size_t offset, const std::string& text, bool merges);
  void addValue(Svar value, std::size_t height);
  void addScalar(std::size_t offset, Svar value, YAML::anchor_t anchor, const std::string& text);
  void remember(YAML::anchor_t anchor, const Anchored& anchored);
  void count(std::size_t offset, std::size_t values);
  void refuseLoneComma(std::size_t offset) const;
  std::string nullText(std::size_t offset) const;

  Svar plainValue(std::size_t offset, const std::string& text) const;
  Svar taggedValue(std::size_t offset, const std::string& tag, const std::string& text) const;
  Svar typedValue(std::size_t offset, const std::string& type, const std::string& text) const;

  Svar binaryValue(std::size_t offset, const std::string& text) const;

  void open(std::size_t offset, const std::string& tag, YAML::anchor_t anchor, bool is_object);
  [[noreturn]] void failName(std::size_t offset, const std::string& what) const;
  void close(Svar value);
  detail::OrderedMap<Svar> ownMembers(std::vector<Svar::Member>& merged);
  void addMerged(std::size_t i, const Svar& value, std::vector<Svar::Member>& merged);
  void resolveRepeat(detail::OrderedMap<Svar>& map, detail::OrderedMap<Svar>::Repeat repeat,
                     const std::vector<std::size_t>& offsets) const;
  void checkMatrix(const std::string& type, const Svar& matrix) const;

  const YamlText& text_;
  const YamlOptions& options_;
  const bool one_;
  std::vector<Svar> documents_;
  std::vector<Svar> values_;
  std::vector<Name> names_;  // of the members of all open objects
  std::vector<Open> open_;
  std::vector<Anchored> anchored_;
  std::size_t count_ = 0;
  std::size_t document_ = 0;     // where the document begins
  bool saw_document_ = false;    // whether one began
  bool is_no_document_ = false;  // but for its end mark
};

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_YAML_BUILDER_H
