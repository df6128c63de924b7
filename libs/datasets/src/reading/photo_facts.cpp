#include "photo_facts.h"

#include <gslam/base/error.h>
#include <gslam/core/geodesy.h>

#include <cmath>
#include <cstdio>
#include <exiv2/exiv2.hpp>
#include <mutex>

#include "second.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

// exiv2's XMP parser has global state, and its warnings go to stderr unless told.
std::mutex& exivMutex() {
  static std::mutex mutex;
  static const bool is_ready = [] {
    Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
    return Exiv2::XmpParser::initialize();
  }();
  (void)is_ready;
  return mutex;
}

const Exiv2::Exifdatum* find(const Exiv2::ExifData& exif, const char* key) {
  const auto found = exif.findKey(Exiv2::ExifKey(key));
  return found == exif.end() || found->count() == 0 ? nullptr : &*found;
}

// NaN where a fraction has no denominator.
double fraction(const Exiv2::Exifdatum& datum, long i = 0) {
  const Exiv2::Rational value = datum.toRational(i);
  return value.second == 0 ? std::nan("") : double(value.first) / double(value.second);
}

// Degrees of degrees, minutes and seconds.
bool readAngle(const Exiv2::ExifData& exif, const char* key, const char* side_key, char negative,
               double& degrees) {
  const Exiv2::Exifdatum* const datum = find(exif, key);
  const Exiv2::Exifdatum* const side = find(exif, side_key);
  if (datum == nullptr || side == nullptr) return false;
  degrees = 0;
  double unit = 1;
  for (long i = 0; i < datum->count() && i < 3; ++i, unit /= 60) {
    degrees += fraction(*datum, i) * unit;
  }
  const std::string name = side->toString();
  if (!name.empty() && name[0] == negative) degrees = -degrees;
  return std::isfinite(degrees) && std::fabs(degrees) <= 180;
}

bool readAltitude(const Exiv2::ExifData& exif, double& altitude) {
  const Exiv2::Exifdatum* const datum = find(exif, "Exif.GPSInfo.GPSAltitude");
  if (datum == nullptr) return false;
  altitude = fraction(*datum);
  const Exiv2::Exifdatum* const side = find(exif, "Exif.GPSInfo.GPSAltitudeRef");
  if (side != nullptr && side->toLong() == 1) altitude = -altitude;
  return std::isfinite(altitude);
}

// The status V: measuring is interrupted.
bool isInterrupted(const Exiv2::ExifData& exif) {
  const Exiv2::Exifdatum* const status = find(exif, "Exif.GPSInfo.GPSStatus");
  return status != nullptr && status->toString() == "V";
}

// Drones write zeros before they have a fix.
void readPosition(const Exiv2::ExifData& exif, PhotoFacts& facts) {
  double latitude = 0, longitude = 0, altitude = 0;
  facts.has_position =
      readAngle(exif, "Exif.GPSInfo.GPSLatitude", "Exif.GPSInfo.GPSLatitudeRef", 'S', latitude) &&
      readAngle(exif, "Exif.GPSInfo.GPSLongitude", "Exif.GPSInfo.GPSLongitudeRef", 'W',
                longitude) &&
      readAltitude(exif, altitude) && std::fabs(latitude) <= 90 &&
      !(latitude == 0 && longitude == 0) && !isInterrupted(exif);
  if (facts.has_position) facts.position = geodeticOfDegrees(latitude, longitude, altitude);
}

// Days from 1970 to a date of the Gregorian calendar (H. Hinnant, "chrono-compatible low-level date
// algorithms", days_from_civil).
std::int64_t daysTo(int year, int month, int day) {
  const std::int64_t y = year - (month <= 2 ? 1 : 0);
  const std::int64_t era = (y >= 0 ? y : y - 399) / 400;
  const std::int64_t of_era = y - era * 400;
  const std::int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

// "2016:06:23 16:31:59" and the digits of a fraction; 0 where it is no date.
std::int64_t stampOf(const std::string& date, const std::string& fraction_digits) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  const int count = std::sscanf(date.c_str(), "%4d:%2d:%2d %2d:%2d:%2d", &year, &month, &day, &hour,
                                &minute, &second);
  const bool is_date = count == 6 && year >= 1970 && year < 2262 && month >= 1 && month <= 12 &&
                       day >= 1 && day <= 31;
  if (!is_date) return 0;
  std::int64_t nanoseconds = 0, unit = kSecond / 10;
  for (const char c : fraction_digits) {
    if (c < '0' || c > '9' || unit == 0) break;
    nanoseconds += (c - '0') * unit;
    unit /= 10;
  }
  return (daysTo(year, month, day) * 86400 + hour * 3600 + minute * 60 + second) * kSecond +
         nanoseconds;
}

void readStamps(const Exiv2::ExifData& exif, PhotoFacts& facts) {
  const auto text = [&](const char* key) {
    const Exiv2::Exifdatum* const datum = find(exif, key);
    return datum == nullptr ? std::string() : datum->toString();
  };
  facts.camera_stamp =
      stampOf(text("Exif.Photo.DateTimeOriginal"), text("Exif.Photo.SubSecTimeOriginal"));
  const Exiv2::Exifdatum* const time = find(exif, "Exif.GPSInfo.GPSTimeStamp");
  if (time == nullptr || time->count() != 3) return;
  const std::int64_t day = stampOf(text("Exif.GPSInfo.GPSDateStamp") + " 00:00:00", "");
  const double seconds = fraction(*time, 0) * 3600 + fraction(*time, 1) * 60 + fraction(*time, 2);
  if (day == 0 || !(seconds >= 0 && seconds < 86401)) return;
  facts.gps_stamp = day + std::int64_t(std::llround(seconds * 1e6)) * 1000;
}

void readCamera(const Exiv2::ExifData& exif, PhotoFacts& facts) {
  for (const char* key : {"Exif.Image.Make", "Exif.Image.Model"}) {
    const Exiv2::Exifdatum* const datum = find(exif, key);
    if (datum == nullptr) continue;
    facts.camera += (facts.camera.empty() ? "" : " ") + datum->toString();
  }
  if (const Exiv2::Exifdatum* const datum = find(exif, "Exif.Photo.FocalLengthIn35mmFilm")) {
    facts.focal_length_35mm = double(datum->toLong());
  }
  if (const Exiv2::Exifdatum* const datum = find(exif, "Exif.Photo.ExposureTime")) {
    const double seconds = fraction(*datum);
    if (seconds > 0 && seconds < 3600) facts.exposure = std::llround(seconds * 1e9);
  }
}

bool readNumber(const Exiv2::XmpData& xmp, const char* key, double& value) {
  const auto found = xmp.findKey(Exiv2::XmpKey(key));
  if (found == xmp.end()) return false;
  value = double(found->toFloat());
  return found->value().ok() && std::isfinite(value);
}

void readDrone(const Exiv2::XmpData& xmp, PhotoFacts& facts) {
  if (xmp.empty()) return;
  try {
    facts.has_gimbal = readNumber(xmp, "Xmp.drone-dji.GimbalYawDegree", facts.gimbal_yaw) &&
                       readNumber(xmp, "Xmp.drone-dji.GimbalPitchDegree", facts.gimbal_pitch) &&
                       readNumber(xmp, "Xmp.drone-dji.GimbalRollDegree", facts.gimbal_roll);
    (void)readNumber(xmp, "Xmp.drone-dji.RelativeAltitude", facts.height);
  } catch (const Exiv2::AnyError&) {  // its prefix is not known: no photo of a DJI was read yet
    facts.has_gimbal = false;
  }
}

}  // namespace

PhotoFacts photoFacts(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  const std::lock_guard<std::mutex> lock(exivMutex());
  PhotoFacts facts;
  try {
    const auto image = Exiv2::ImageFactory::open(bytes.data(), static_cast<long>(bytes.size()));
    image->readMetadata();
    readPosition(image->exifData(), facts);
    readStamps(image->exifData(), facts);
    readCamera(image->exifData(), facts);
    readDrone(image->xmpData(), facts);
  } catch (const Exiv2::AnyError& error) {
    throw FileError(name, std::string("its EXIF data cannot be read: ") + error.what());
  }
  return facts;
}

// EXIF and XMP stand before the pixels, each in less than 64 KiB, but in TIFF files anywhere.
PhotoFacts photoFacts(const FileTree& tree, const std::string& file) {
  constexpr std::size_t kHead = 1 << 18;
  const std::vector<std::uint8_t> head = tree.read(file, kHead);
  try {
    return photoFacts(head, tree.nameOf(file));
  } catch (const FileError&) {
    if (head.size() < kHead) throw;
  }
  return photoFacts(tree.read(file), tree.nameOf(file));
}

bool hasPosition(const FileTree& tree, const std::string& file) {
  try {
    return photoFacts(tree, file).has_position;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
