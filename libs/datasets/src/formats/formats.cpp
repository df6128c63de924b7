#include <gslam/core/detail/shared_library.h>
#include <gslam/core/parameters.h>
#include <gslam/datasets/formats.h>

#include <algorithm>

namespace gslam {
inline namespace v1 {

std::vector<DatasetFactory> datasetFormats() {
  return {kittiFactory(),   kittiRawFactory(),    tumFactory(),     iclFactory(),
          tumMonoFactory(), eurocFactory(),       tumViFactory(),   droneMapFactory(),
          photosFactory(),  sevenScenesFactory(), strechaFactory(), folderFactory(),
          cvMonoFactory()};
}

namespace {

const DatasetFactory* findFormat(const std::vector<DatasetFactory>& formats,
                                 const std::string& name) {
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const DatasetFactory& one) { return one.name == name; });
  return found == formats.end() ? nullptr : &*found;
}

}  // namespace

std::unique_ptr<Dataset> openDataset(const std::string& path, const Svar& parameters) {
  const std::vector<DatasetFactory> formats = datasetFormats();
  const std::size_t colon = path.find(':');
  const DatasetFactory* format =
      colon == std::string::npos ? nullptr : findFormat(formats, path.substr(0, colon));
  const std::string place = format == nullptr ? path : path.substr(colon + 1);
  if (format == nullptr) format = findFormat(formats, datasetFormatOf(path));
  if (format == nullptr) {
    const bool is_there = detail::fileKind(path) != detail::FileKind::none;
    throw FileError(path, is_there ? "is no dataset of a known format" : "does not exist");
  }
  return format->open(place, completeParameters(format->parameters, parameters));
}

}  // namespace v1
}  // namespace gslam
