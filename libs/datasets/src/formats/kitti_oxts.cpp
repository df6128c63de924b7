// Sources: dataformat.txt of the archives for the fields; convertOxtsToPose.m and
// latlonToMercator.m of the devkit for poses. Its first pose is the identity; here, only the place
// of the first one is taken away, so that z stays up.
#include "kitti_oxts.h"

#include <gslam/base/error.h>
#include <gslam/core/geodesy.h>
#include <gslam/core/stamp.h>

#include <cmath>
#include <utility>

#include "number_file.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kFields = 30;
enum Field : std::size_t {
  lat = 0,
  lon = 1,
  alt = 2,
  roll = 3,
  pitch = 4,
  yaw = 5,
  vn = 6,
  ve = 7,
  vu = 10,
  ax = 11,
  wx = 17,
  pos_accuracy = 23,
  posmode = 27
};

// Days from 1970-01-01 to a day of the Gregorian calendar. Source: H. Hinnant, "chrono-compatible
// low-level date algorithms".
std::int64_t daysOf(std::int64_t year, std::int64_t month, std::int64_t day) {
  if (month <= 2) --year;
  const std::int64_t era = year / 400, year_of_era = year - era * 400;
  const std::int64_t month_from_march = month + (month > 2 ? -3 : 9);
  const std::int64_t day_of_year = (153 * month_from_march + 2) / 5 + day - 1;
  const std::int64_t day_of_era =
      year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
  return era * 146097 + day_of_era - 719468;
}

// Reads `count` digits.
bool readDigits(const std::string& text, std::size_t place, std::size_t count,
                std::int64_t& value) {
  value = 0;
  for (std::size_t i = place; i < place + count; ++i) {
    if (i >= text.size() || text[i] < '0' || text[i] > '9') return false;
    value = value * 10 + (text[i] - '0');
  }
  return true;
}

bool readDate(const std::string& text, std::int64_t& days) {
  std::int64_t year = 0, month = 0, day = 0;
  const bool is_date = text.size() == 10 && text[4] == '-' && text[7] == '-' &&
                       readDigits(text, 0, 4, year) && readDigits(text, 5, 2, month) &&
                       readDigits(text, 8, 2, day);
  days = is_date ? daysOf(year, month, day) : 0;
  if (!is_date || year < 1970 || year >= 2262 || month < 1 || month > 12 || day < 1) return false;
  return days < (month == 12 ? daysOf(year + 1, 1, 1) : daysOf(year, month + 1, 1));
}

bool readTime(const std::string& text, std::int64_t& nanoseconds) {
  std::int64_t hour = 0, minute = 0;
  const bool begins = text.size() >= 8 && text[2] == ':' && text[5] == ':' &&
                      readDigits(text, 0, 2, hour) && readDigits(text, 3, 2, minute);
  if (!begins || hour > 23 || minute > 59 || text[6] < '0' || text[6] > '6') return false;
  const char* const end = text.data() + text.size();
  const detail::ParsedStamp seconds = detail::parseStamp(text.data() + 6, end, 9);
  nanoseconds = (hour * 60 + minute) * 60 * 1000000000 + seconds.value;
  return seconds.status == detail::StampStatus::ok && seconds.end == end &&
         seconds.value <= 60999999999;
}

// The position modes of OXTS's receivers, which are NovAtel's.
GnssFix fixOf(double mode) {
  switch (static_cast<int>(mode)) {
    case 3:
    case 13:
      return GnssFix::single;
    case 4:
    case 7:
    case 8:
    case 9:
    case 14:
    case 17:
    case 18:
      return GnssFix::augmented;
    case 5:
    case 15:
      return GnssFix::rtk_float;
    case 6:
    case 16:
      return GnssFix::rtk_fixed;
    default:
      return GnssFix::none;
  }
}

SO3d rotationAbout(std::size_t axis, double angle) {
  Vec3d omega{};
  omega[axis] = angle;
  return SO3d::exp(omega);
}

void checkRanges(const std::vector<double>& v, const std::string& source) {
  const bool is_place = std::fabs(v[lat]) < 90 && std::fabs(v[lon]) <= 360;
  const bool is_mode = v[posmode] >= 0 && v[posmode] <= 1000;
  if (is_place && is_mode) return;
  throw ParseError(source, 1, 0,
                   is_place ? "field 28, the mode of the position, is out of its range"
                            : "fields 1 and 2 are no latitude and longitude in degrees");
}

}  // namespace

std::vector<std::int64_t> readDateTimes(const FileTree& tree, const std::string& file) {
  const std::string text = tree.text(file), source = tree.nameOf(file);
  detail::FieldReader in(text, source, "a date and a time: 2011-09-26 13:02:25.951199337");
  std::vector<std::int64_t> stamps;
  while (in.nextLine()) {
    const char* const at = in.place();
    const std::string date = in.word();
    in.skipWord();
    const std::string time = in.isLineEnd() ? "" : in.word();
    std::int64_t days = 0, nanoseconds = 0;
    if (!readDate(date, days) || !readTime(time, nanoseconds)) {
      in.fail(at, detail::quotedText(date) + " and " + detail::quotedText(time) +
                      " are no date and time, expected such as 2011-09-26 13:02:25.951199337");
    }
    in.skipWord();
    in.endLine();
    stamps.push_back(days * 86400 * 1000000000 + nanoseconds);
  }
  return stamps;
}

OxtsSample readOxts(const FileTree& tree, const std::string& file, std::int64_t stamp) {
  const std::vector<double> v =
      readNumbers(tree, file, kFields, "the 30 fields that dataformat.txt lists");
  checkRanges(v, tree.nameOf(file));
  OxtsSample sample{};
  sample.imu = {stamp, {{v[wx], v[wx + 1], v[wx + 2]}}, {{v[ax], v[ax + 1], v[ax + 2]}}};
  sample.gnss.stamp = stamp;
  sample.gnss.position = {radiansOfDegrees(v[lat]), radiansOfDegrees(v[lon]), v[alt]};
  const double variance = v[pos_accuracy] * v[pos_accuracy];
  sample.gnss.covariance(0, 0) = sample.gnss.covariance(1, 1) = variance;
  sample.gnss.covariance(2, 2) = 4 * variance;
  sample.gnss.velocity = {{v[ve], v[vn], v[vu]}};
  sample.gnss.fix = fixOf(v[posmode]);
  sample.rotation =
      rotationAbout(2, v[yaw]) * rotationAbout(1, v[pitch]) * rotationAbout(0, v[roll]);
  return sample;
}

Trajectory oxtsTrajectory(const std::vector<OxtsSample>& samples) {
  std::vector<StampedPose> poses;
  if (samples.empty()) return Trajectory();
  const double scale = std::cos(samples[0].gnss.position.latitude) * kWgs84Radius;
  Vec3d origin{};
  for (const OxtsSample& sample : samples) {
    const Geodetic& at = sample.gnss.position;
    const Vec3d place = {
        {scale * at.longitude, scale * std::log(std::tan(kPi / 4 + at.latitude / 2)), at.altitude}};
    if (poses.empty()) origin = place;
    poses.push_back({sample.imu.stamp, SE3d(sample.rotation, place - origin)});
  }
  return Trajectory(std::move(poses));
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
