#ifndef GSLAM_CORE_OPEN_DATASET_H
#define GSLAM_CORE_OPEN_DATASET_H

#include <gslam/core/dataset.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/core/parameters.h>
#include <gslam/core/plugins.h>
#include <gslam/svar/svar.h>

#include <cstddef>
#include <memory>
#include <string>

/// @file
/// Opens whatever a user calls a dataset.

namespace gslam {
inline namespace v1 {
namespace detail {

// How many characters before a colon name a kind of dataset; 0: none do.
inline std::size_t kindLength(const std::string& what) noexcept {
  const std::size_t length = what.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-");
  return length != std::string::npos && what[length] == ':' ? length : 0;
}

}  // namespace detail

/// Opens a dataset.
///
///     /data/MH_01_easy         a file or folder: the kind of dataset that recognizes it
///     euroc:/data/MH_01_easy   the same, where several do
///     synthetic://room?seed=1  a kind of dataset that has no files
///     synthetic                the same, as its parameters have it
///
/// @param plugins     that may have its kind
/// @param what        one of these
/// @param parameters  an object with those that are not as DatasetFactory::parameters has them
/// @throws FileError when there is no such file, or nothing recognizes it; Error for an unknown
///   kind; SvarError for a parameter that it does not have; and what opening it throws
inline std::unique_ptr<Dataset> openDataset(Plugins& plugins, const std::string& what,
                                            const Svar& parameters = Svar()) {
  const auto open = [&parameters](const DatasetFactory& factory, const std::string& path) {
    return factory.open(path, completeParameters(factory.parameters, parameters));
  };
  if (detail::fileKind(what) != detail::FileKind::none) {
    return open(plugins.datasetFor(what), what);
  }
  const std::size_t kind = detail::kindLength(what);
  if (kind > 0) {
    const bool is_url = what.compare(kind, 3, "://") == 0;
    return open(plugins.dataset(what.substr(0, kind)), is_url ? what : what.substr(kind + 1));
  }
  if (what.find('/') != std::string::npos) {
    throw FileError(what, "does not exist, expected a dataset");
  }
  return open(plugins.dataset(what), what);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_OPEN_DATASET_H
