// Instantiates the templates of GSLAM::core; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/core.h>
#include <gslam/core/isolated_slam.h>
#include <gslam/core/isolation_worker.h>
#include <gslam/core/map_file.h>
#include <gslam/core/open_dataset.h>
#include <gslam/core/ply.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/svar.h>  // all of it: names in `detail` are shared

#include <cstdint>
#include <istream>
#include <memory>
#include <ostream>
#include <string>

template <class T>
double instantiateImage(gslam::Image& image) {
  const gslam::Image& same = image;
  return static_cast<double>(*image.row<T>(0)) + static_cast<double>(*same.row<T>(0)) +
         static_cast<double>(image.at<T>(0, 0)) + static_cast<double>(same.at<T>(0, 0)) +
         static_cast<double>(*image.span<T>().data) + static_cast<double>(*same.span<T>().data);
}
template double instantiateImage<std::uint8_t>(gslam::Image&);
template double instantiateImage<std::int8_t>(gslam::Image&);
template double instantiateImage<std::uint16_t>(gslam::Image&);
template double instantiateImage<std::int16_t>(gslam::Image&);
template double instantiateImage<std::uint32_t>(gslam::Image&);
template double instantiateImage<std::int32_t>(gslam::Image&);
template double instantiateImage<std::uint64_t>(gslam::Image&);
template double instantiateImage<std::int64_t>(gslam::Image&);
template double instantiateImage<float>(gslam::Image&);
template double instantiateImage<double>(gslam::Image&);

bool instantiateHandles(void* pixels);

bool instantiateHandles(void* pixels) {
  const gslam::Image image =
      gslam::Image::wrap(pixels, 4, 4, gslam::PixelType::u8, 1, 0, [] {}).view(0, 0, 2, 2);
  return image == image.clone() && image != gslam::Image(2, 2, gslam::PixelType::u8) &&
         image.text().empty();
}

gslam::Trajectory instantiateTrajectories(std::istream& in, std::ostream& out,
                                          const std::string& path);

gslam::Trajectory instantiateTrajectories(std::istream& in, std::ostream& out,
                                          const std::string& path) {
  gslam::Trajectory t = gslam::readTrajectory(in, "stream");
  gslam::writeTrajectory(out, t, gslam::TrajectoryFormat::euroc);
  gslam::writeTrajectory(path, t);
  gslam::writeStamps(path, t);
  gslam::SE3d pose;
  if (t.interpolate(gslam::parseStamp("1.5"), pose)) t.add(2, pose);
  out << gslam::secondsText(t.nearest(3)->stamp) << t.length() << t.duration();
  return gslam::readKittiTrajectory(path, path);
}

double instantiateGeodesy(const gslam::Geodetic& place);

double instantiateGeodesy(const gslam::Geodetic& place) {
  const gslam::EnuFrame frame(place);
  return frame.toGeodetic(frame.fromGeodetic(place)).altitude + frame.T_ecef_enu().log()[0];
}

std::size_t instantiateMaps(gslam::Map& map, const std::string& path);

std::size_t instantiateMaps(gslam::Map& map, const std::string& path) {
  gslam::SharedMap shared(gslam::loadMap(path));
  map.transform(gslam::SIM3d());
  map.merge(map.add(gslam::MapPoint()), map.add(gslam::MapPoint()));
  gslam::saveMap(path, map);
  gslam::savePly(path, map);
  return gslam::keyframeTrajectory(*shared.publish()).size() + gslam::loadPly(path).size();
}

int instantiatePlugins(int argc, const char* const* argv, const std::string& path);

int instantiatePlugins(int argc, const char* const* argv, const std::string& path) {
  if (gslam::isIsolationWorker(argc, argv)) return gslam::runIsolationWorker(argc, argv);
  gslam::Plugins plugins;
  const std::unique_ptr<gslam::Dataset> dataset = gslam::openDataset(plugins, path);
  gslam::IsolatedSlam slam{gslam::IsolationOptions()};
  const gslam::Messenger messenger;
  gslam::Player player(*dataset, messenger);
  return int(gslam::runSlam(slam, player, *dataset, gslam::RunSetup(), messenger).poses.size());
}
