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
  const std::size_t length = what.find_first_not_of(kNameCharacters);
  return length != std::string::npos && what[length] == ':' ? length : 0;
}

}  // namespace detail

/// A kind of dataset, and what it is to open.
struct FoundDataset {
  DatasetFactory factory;  ///< the kind
  std::string path;        ///< for DatasetFactory::open
};

/// Finds out what a user calls a dataset.
///
///     /data/MH_01_easy         a file or folder: the kind of dataset that recognizes it
///     euroc:/data/MH_01_easy   the same, where several do
///     synthetic://room?seed=1  a kind of dataset that has no files
///     synthetic                the same, as its parameters have it
///
/// @param plugins  that may have its kind
/// @param what     one of these
/// @throws FileError when there is no such file, or nothing recognizes it; Error for an unknown
///   kind
inline FoundDataset findDataset(Plugins& plugins, const std::string& what) {
  const std::size_t kind = detail::kindLength(what);
  if (kind > 0) {
    const bool is_url = what.compare(kind, 3, "://") == 0;
    return {plugins.dataset(what.substr(0, kind)), is_url ? what : what.substr(kind + 1)};
  }
  const bool is_name =
      !what.empty() && what.find_first_not_of(detail::kNameCharacters) == std::string::npos;
  if (detail::fileKind(what) == detail::FileKind::none) {
    if (is_name) return {plugins.dataset(what), what};
    throw FileError(what, "does not exist, expected a dataset");
  }
  try {
    return {plugins.datasetFor(what), what};
  } catch (const FileError&) {
    // A folder that happens to have the name of a kind.
    if (!is_name || detail::findFactory<DatasetFactory>(plugins.registry(), what) == nullptr) throw;
  }
  return {plugins.dataset(what), what};
}

/// Opens a dataset.
/// @param found       what findDataset() found
/// @param parameters  all of them, as completeParameters() gives them
/// @throws what opening it throws; Error when that gives none
inline std::unique_ptr<Dataset> openDataset(const FoundDataset& found, const Svar& parameters) {
  std::unique_ptr<Dataset> dataset = found.factory.open(found.path, parameters);
  if (dataset != nullptr) return dataset;
  throw Error("the factory of dataset '" + found.factory.name + "' opened none for " + found.path);
}

/// Opens whatever a user calls a dataset, see findDataset().
/// @param plugins     that may have its kind
/// @param what        as there
/// @param parameters  an object with those that are not as DatasetFactory::parameters has them
/// @throws as findDataset() and openDataset(); SvarError for a parameter that it does not have
inline std::unique_ptr<Dataset> openDataset(Plugins& plugins, const std::string& what,
                                            const Svar& parameters = Svar()) {
  const FoundDataset found = findDataset(plugins, what);
  return openDataset(found, completeParameters(found.factory.parameters, parameters));
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_OPEN_DATASET_H
