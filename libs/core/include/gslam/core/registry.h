#ifndef GSLAM_CORE_REGISTRY_H
#define GSLAM_CORE_REGISTRY_H

#include <gslam/base/error.h>
#include <gslam/core/application.h>
#include <gslam/core/dataset.h>
#include <gslam/core/rig.h>
#include <gslam/core/slam.h>
#include <gslam/svar/svar.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// @file
/// What plugins bring: datasets, SLAM systems and applications, by name.

namespace gslam {
inline namespace v1 {

namespace detail {
constexpr const char* kNameCharacters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
}  // namespace detail

/// A kind of dataset, and how to open one.
struct DatasetFactory {
  std::string name;         ///< such as "euroc"
  std::string description;  ///< one sentence
  Svar parameters;          ///< an object with the defaults
  /// Whether a file or folder looks as if open() could read it. Reads little. Empty: never.
  std::function<bool(const std::string& path)> recognizes;
  /// Opens one. `parameters` has those above, with the values the user wants. Throws an Error that
  /// names the file and what was expected.
  std::function<std::unique_ptr<Dataset>(const std::string& path, const Svar& parameters)> open;
  Svar help;  ///< an object: what a parameter means, by its name; of none, some or all
};

/// A SLAM system, and how to make one.
struct SlamFactory {
  std::string name;                             ///< such as "orb"
  std::string description;                      ///< one sentence
  Svar parameters;                              ///< an object with the defaults
  SensorNeeds needs;                            ///< what it cannot do without
  std::function<std::unique_ptr<Slam>()> make;  ///< one that is not configured yet
  Svar help;  ///< an object: what a parameter means, by its name; of none, some or all
};

/// An application, and how to make one.
struct ApplicationFactory {
  std::string name;                                    ///< such as "viewer"
  std::string description;                             ///< one sentence
  Svar parameters;                                     ///< an object with the defaults
  std::function<std::unique_ptr<Application>()> make;  ///< one that does not run yet
  Svar help;  ///< an object: what a parameter means, by its name; of none, some or all
};

/// A SLAM system that a factory makes.
/// @throws what the factory throws; Error when it makes none
inline std::unique_ptr<Slam> makeSlam(const SlamFactory& factory) {
  std::unique_ptr<Slam> slam = factory.make();
  if (slam == nullptr) throw Error("the factory of SLAM system '" + factory.name + "' made none");
  return slam;
}

/// The factories that a plugin adds when it is loaded. One thread at a time may write it.
class Registry {
 public:
  /// @{
  /// Adds a factory.
  /// @throws ArgumentError when its name is empty, has other characters than letters, digits and _
  ///   (it is part of topics), or is taken by one of its kind; when what makes it is missing; when
  ///   its help is no object of texts, or explains a parameter that it does not have
  void add(DatasetFactory factory) {
    check(datasets_, factory, factory.open != nullptr, "dataset");
    datasets_.push_back(std::move(factory));
  }
  void add(SlamFactory factory) {
    check(slams_, factory, factory.make != nullptr, "SLAM system");
    slams_.push_back(std::move(factory));
  }
  void add(ApplicationFactory factory) {
    check(applications_, factory, factory.make != nullptr, "application");
    applications_.push_back(std::move(factory));
  }
  /// @}

  /// @{
  /// All of a kind, in the order they were added.
  const std::vector<DatasetFactory>& datasets() const noexcept { return datasets_; }
  const std::vector<SlamFactory>& slams() const noexcept { return slams_; }
  const std::vector<ApplicationFactory>& applications() const noexcept { return applications_; }
  /// @}

 private:
  template <class Factory>
  static void check(const std::vector<Factory>& known, const Factory& added, bool is_whole,
                    const std::string& kind) {
    if (added.name.empty()) throw ArgumentError("name", "of a " + kind + " is empty");
    if (added.name.find_first_not_of(detail::kNameCharacters) != std::string::npos) {
      throw ArgumentError("'" + added.name + "'",
                          "is no name for a " + kind + ", expected letters, digits and _");
    }
    if (!is_whole) throw ArgumentError(added.name, "has no function that makes the " + kind);
    for (const Factory& other : known) {
      if (other.name == added.name) {
        throw ArgumentError(added.name, "is the name of another " + kind + " already");
      }
    }
    checkHelp(added.name, added.parameters, added.help);
  }

  static void checkHelp(const std::string& name, const Svar& parameters, const Svar& help) {
    if (help.isNull()) return;
    if (help.type() != SvarType::object)
      throw ArgumentError("help", "of " + name + " is no object");
    for (const Svar::Member& one : help.members()) {
      if (one.second.type() != SvarType::string) {
        throw ArgumentError("help", "of " + name + " for '" + one.first + "' is no text");
      }
      if (parameters.type() != SvarType::object || !parameters.contains(one.first)) {
        throw ArgumentError("help", "of " + name + " explains '" + one.first +
                                        "', which is none of its parameters");
      }
    }
  }

  std::vector<DatasetFactory> datasets_;
  std::vector<SlamFactory> slams_;
  std::vector<ApplicationFactory> applications_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_REGISTRY_H
