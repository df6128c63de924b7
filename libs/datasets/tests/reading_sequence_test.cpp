#include <gslam/base/error.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <set>
#include <thread>

#include "../src/reading/camera_words.h"
#include "../src/reading/image_list.h"
#include "../src/reading/sequence.h"
#include "reading_case.h"

namespace {

using namespace gslam::reading;  // NOLINT(google-build-using-namespace)
using gslam::Image;
using gslam::ImuSample;
using gslam::PixelType;
using reading_case::hasRemark;
using reading_case::messageOf;
using reading_case::TempFolder;

constexpr std::int64_t kStep = 50000000;

// What threads of a sequence do, counted.
struct Loads {
  std::mutex mutex;
  std::vector<std::size_t> frames;
  std::set<std::thread::id> threads;
  std::atomic<int> at_once{0}, most_at_once{0};
};

gslam::CameraSensor namedCamera(const std::string& name) {
  gslam::CameraSensor camera;
  camera.name = name;
  return camera;
}

// Frames whose only pixel is their number.
Sequence numberedSequence(std::size_t count, const std::shared_ptr<Loads>& loads) {
  Sequence sequence;
  sequence.info.name = "numbered";
  sequence.info.sensors.cameras.push_back(namedCamera("only"));
  for (std::size_t i = 0; i < count; ++i) sequence.stamps.push_back(std::int64_t(i) * kStep);
  sequence.load = [loads](std::size_t frame, std::size_t) {
    const int now = ++loads->at_once;
    if (now > loads->most_at_once) loads->most_at_once = now;
    {
      const std::lock_guard<std::mutex> lock(loads->mutex);
      loads->frames.push_back(frame);
      loads->threads.insert(std::this_thread::get_id());
    }
    std::this_thread::sleep_for(std::chrono::microseconds(frame % 3 * 100));
    --loads->at_once;
    if (frame == 13) throw gslam::Error("number 13 is damaged");
    Image image(1, 1, PixelType::i32);
    image.at<std::int32_t>(0, 0) = std::int32_t(frame);
    return image;
  };
  return sequence;
}

int numberIn(const gslam::Frame& frame) {
  return frame.images.at(0).image.at<std::int32_t>(0, 0);
}

void expectFrames(gslam::Dataset& dataset, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    if (i == 13) {
      EXPECT_EQ(messageOf([&] { (void)dataset.next(); }), "number 13 is damaged");
      continue;
    }
    const auto frame = dataset.next();
    ASSERT_NE(frame, nullptr);
    ASSERT_EQ(frame->id, i);
    ASSERT_EQ(frame->stamp, std::int64_t(i) * kStep);
    ASSERT_EQ(numberIn(*frame), int(i));
  }
}

class ReadingThreads : public testing::TestWithParam<int> {};

TEST_P(ReadingThreads, frames_come_in_order_whatever_happens) {
  const auto loads = std::make_shared<Loads>();
  const auto dataset = deliver(numberedSequence(200, loads), {GetParam(), 7});
  expectFrames(*dataset, 0, 200);
  EXPECT_EQ(dataset->next(), nullptr);
  EXPECT_EQ(dataset->next(), nullptr);
  for (const std::size_t place : {150U, 13U, 0U, 199U, 200U, 60U}) {
    dataset->seek(place);
    expectFrames(*dataset, place, std::min<std::size_t>(place + 20, 200));
  }
  EXPECT_THROW(dataset->seek(201), gslam::ArgumentError);
  EXPECT_LE(loads->most_at_once, std::max(1, GetParam()));
  EXPECT_EQ(loads->threads.count(std::this_thread::get_id()), GetParam() == 0 ? 1U : 0U);
}

TEST_P(ReadingThreads, it_may_go_at_any_time) {
  for (std::size_t taken = 0; taken < 20; ++taken) {
    const auto dataset = deliver(numberedSequence(200, std::make_shared<Loads>()), {GetParam(), 5});
    expectFrames(*dataset, 0, std::min<std::size_t>(taken, 12));
    if (taken % 3 == 0) dataset->seek(100);
  }
}

INSTANTIATE_TEST_SUITE_P(counts, ReadingThreads, testing::Values(0, 1, 2, 5));

TEST(reading_sequence, loads_no_more_ahead_than_it_may) {
  const auto loads = std::make_shared<Loads>();
  const auto dataset = deliver(numberedSequence(100, loads), {3, 6});
  for (int i = 0; i < 10; ++i) (void)dataset->next();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::lock_guard<std::mutex> lock(loads->mutex);
  EXPECT_EQ(loads->frames.size(), 16U);  // those that were taken, and six
}

TEST(reading_sequence, opening_loads_nothing_and_a_jump_little) {
  const auto loads = std::make_shared<Loads>();
  const auto dataset = deliver(numberedSequence(100, loads), {2, 50});
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_TRUE(loads->frames.empty());
  for (const std::size_t place : {80U, 20U, 60U}) {
    dataset->seek(place);
    EXPECT_EQ(numberIn(*dataset->next()), int(place));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::lock_guard<std::mutex> lock(loads->mutex);
  EXPECT_LE(loads->frames.size(), 15U);  // at each place the frame itself, and four ahead
}

TEST(reading_sequence, one_thread_loads_in_order_where_that_is_wanted) {
  const auto loads = std::make_shared<Loads>();
  Sequence sequence = numberedSequence(12, loads);
  sequence.in_order = true;
  const auto dataset = deliver(std::move(sequence), {4, 6});
  expectFrames(*dataset, 0, 12);
  EXPECT_EQ(loads->threads.size(), 1U);
  EXPECT_TRUE(std::is_sorted(loads->frames.begin(), loads->frames.end()));
}

TEST(reading_sequence, samples_go_out_once_with_the_frame_after_them) {
  Sequence sequence = numberedSequence(5, std::make_shared<Loads>());
  for (std::int64_t stamp = -20; stamp <= 5 * kStep; stamp += 10000000) {
    ImuSample sample{};
    sample.stamp = stamp;
    sequence.imu.push_back(sample);
  }
  const std::size_t count = sequence.imu.size();
  const auto dataset = deliver(std::move(sequence), {1, 2});
  std::size_t delivered = 0;
  std::int64_t before = -100;
  for (int round = 0; round < 2; ++round, dataset->seek(0), before = -100) {
    delivered = 0;
    while (const auto frame = dataset->next()) {
      for (const ImuSample& sample : frame->imu) {
        EXPECT_GT(sample.stamp, before);
        EXPECT_LE(sample.stamp, frame->stamp);
      }
      before = frame->stamp;
      delivered += frame->imu.size();
    }
  }
  const std::size_t late = count - delivered;
  EXPECT_EQ(late, 5U);
  EXPECT_TRUE(hasRemark(dataset->info(), std::to_string(late) + " of " + std::to_string(count) +
                                             " inertial samples come after the last frame"));
  dataset->seek(3);
  EXPECT_EQ(dataset->next()->imu.size(), 5U);
  EXPECT_NEAR(dataset->info().sensors.imu.rate, 100, 1e-9);
  EXPECT_NEAR(dataset->info().sensors.cameras[0].rate, 20, 1e-9);
}

TEST(reading_sequence, samples_of_a_damaged_frame_go_out_with_the_next) {
  Sequence sequence = numberedSequence(20, std::make_shared<Loads>());
  for (std::int64_t stamp = 0; stamp < 20 * kStep; stamp += 10000000) {
    ImuSample sample{};
    sample.stamp = stamp;
    sequence.imu.push_back(sample);
  }
  const auto dataset = deliver(std::move(sequence), {2, 4});
  std::int64_t before = -10000000;
  for (std::size_t i = 0; i < 20; ++i) {
    if (i == 13) {
      EXPECT_THROW(dataset->next(), gslam::Error);
      continue;
    }
    const auto frame = dataset->next();
    for (const ImuSample& sample : frame->imu) {
      EXPECT_EQ(sample.stamp, before + 10000000);
      before = sample.stamp;
    }
  }
  EXPECT_EQ(before, 19 * kStep);
  dataset->seek(14);
  EXPECT_EQ(dataset->next()->imu.size(), 5U);
}

TEST(reading_sequence, what_is_no_error_of_ours_reaches_the_caller_as_well) {
  Sequence sequence = numberedSequence(2, std::make_shared<Loads>());
  sequence.load = [](std::size_t frame, std::size_t) {
    if (frame == 0) throw std::bad_alloc();
    return Image(1, 1, PixelType::u8);
  };
  const auto dataset = deliver(std::move(sequence), {2, 4});
  EXPECT_THROW(dataset->next(), std::bad_alloc);
  EXPECT_EQ(dataset->next()->id, 1U);
}

TEST(reading_sequence, gaps_and_ground_truth_of_another_time_are_said) {
  Sequence sequence = numberedSequence(12, std::make_shared<Loads>());
  for (std::size_t i = 6; i < 12; ++i) sequence.stamps[i] += 10 * kStep;
  sequence.info.ground_truth.add(2 * kStep, gslam::SE3d());
  sequence.info.ground_truth.add(7 * kStep, gslam::SE3d());
  const auto dataset = deliver(std::move(sequence), {1, 2});
  EXPECT_TRUE(hasRemark(dataset->info(),
                        "the frames have 1 gap of more than twice the usual 0.05 s, "
                        "the longest 0.55 s before number 6"));
  EXPECT_TRUE(hasRemark(dataset->info(), "8 of 12 frames are not in the time of the ground truth"));
  EXPECT_EQ(dataset->info().frame_count, 12U);
  EXPECT_EQ(dataset->info().last_stamp, 21 * kStep);
}

TEST(reading_sequence, refuses_none_and_disorder) {
  EXPECT_THROW(deliver(numberedSequence(0, std::make_shared<Loads>()), {}), gslam::Error);
  Sequence twins = numberedSequence(3, std::make_shared<Loads>());
  twins.stamps[1] = twins.stamps[2];
  EXPECT_THROW(deliver(std::move(twins), {}), gslam::Error);
  Sequence ages = numberedSequence(2, std::make_shared<Loads>());
  ages.stamps = {-9000000000000000000, 9000000000000000000};
  EXPECT_THROW(deliver(std::move(ages), {}), gslam::Error);
  EXPECT_THROW(prefetchOf(gslam::Svar::object({{"threads", -1}})), gslam::ArgumentError);
  EXPECT_THROW(prefetchOf(gslam::Svar::object({{"ahead", 0}})), gslam::ArgumentError);
}

// --- lists of images ---

TEST(reading_list, reads_both_styles_and_windows_line_ends) {
  const TempFolder folder;
  folder.write("tum.txt", "# stamp file\r\n1.25 rgb/a.png\r\n\r\n2.5 rgb/b.png\r\n");
  folder.write("asl.csv", "\xEF\xBB\xBF#timestamp [ns],filename\n1000000001,a.png\n");
  const auto tree = FileTree::open(folder.path());
  const auto tum = readImageList(*tree, "tum.txt", gslam::StampUnit::seconds, "");
  ASSERT_EQ(tum.size(), 2U);
  EXPECT_EQ(tum[1].stamp, 2500000000);
  EXPECT_EQ(tum[1].file, "rgb/b.png");
  EXPECT_EQ(tum[1].line, 4U);
  const auto asl = readImageList(*tree, "asl.csv", gslam::StampUnit::nanoseconds, "cam0/data");
  ASSERT_EQ(asl.size(), 1U);
  EXPECT_EQ(asl[0].stamp, 1000000001);
  EXPECT_EQ(asl[0].file, "cam0/data/a.png");
}

TEST(reading_list, errors_name_the_line) {
  const TempFolder folder;
  folder.write("word.txt", "1.0 a.png\nx b.png\n");
  folder.write("short.txt", "1.0 a.png\n\n2.0\n");
  const auto tree = FileTree::open(folder.path());
  for (const auto& [file, line] :
       {std::pair<const char*, const char*>{"word.txt", ":2:1:"}, {"short.txt", ":3:"}}) {
    const std::string message = messageOf(
        [&, name = file] { (void)readImageList(*tree, name, gslam::StampUnit::seconds, ""); });
    EXPECT_NE(message.find(folder / file + line), std::string::npos) << message;
  }
}

TEST(reading_list, what_is_missing_or_twice_is_counted) {
  const TempFolder folder;
  for (const char* name : {"a.png", "b.png", "c.png"}) folder.write(name, "");
  const auto tree = FileTree::open(folder.path());
  std::vector<ListedImage> images = {
      {3, "c.png", 1, 0}, {1, "a.png", 2, 0}, {2, "lost.png", 3, 0}, {1, "b.png", 4, 0}};
  Remarks remarks;
  tidy(images, *tree, "list.txt", remarks);
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0].file, "a.png");
  EXPECT_EQ(images[1].file, "c.png");
  EXPECT_EQ(
      remarks.sentences(),
      (std::vector<std::string>{
          "skipped 1 images that list.txt lists and that do not exist: lost.png (list.txt:3)",
          "the images of list.txt are not in the order of their stamps: they are sorted",
          "skipped 1 images that have the stamp of another in list.txt: b.png (list.txt:4)"}));
}

TEST(reading_list, frames_have_an_image_of_each_camera) {
  Sequence sequence;
  sequence.info.name = "pair";
  sequence.info.sensors.cameras = {namedCamera("left"), namedCamera("right")};
  const std::vector<ListedImage> left = {{10, "l1", 0, 5}, {20, "l2", 0, 6}, {30, "l3", 0, 7}},
                                 right = {{11, "r1", 0, 8}, {25, "r2", 0, 0}, {31, "r3", 0, 9}};
  const auto names = makeFrames(sequence, {left, right}, 2);
  EXPECT_EQ(names, (std::vector<std::string>{"l1", "r1", "l3", "r3"}));
  EXPECT_EQ(sequence.stamps, (std::vector<std::int64_t>{10, 30}));
  EXPECT_EQ(sequence.exposures, (std::vector<std::int64_t>{5, 8, 7, 9}));
  EXPECT_EQ(sequence.remarks.sentences().size(), 2U);
  Sequence none = sequence;
  none.remarks.skip("images that l.csv lists and that do not exist", "a.png (l.csv:1)");
  const std::string message = messageOf([&] {
    (void)makeFrames(none, {left, {{500, "r", 0, 0}}}, 2);
  });
  EXPECT_NE(message.find("a.png (l.csv:1)"), std::string::npos) << message;
}

// --- files of images ---

Sequence withFiles(const TempFolder& folder, const std::vector<std::string>& names) {
  Sequence sequence;
  sequence.info.name = "files";
  sequence.info.sensors.cameras = {namedCamera("one")};
  for (std::size_t i = 0; i < names.size(); ++i) sequence.stamps.push_back(std::int64_t(i) * kStep);
  loadImageFiles(sequence, {FileTree::open(folder.path()), names});
  return sequence;
}

TEST(reading_images, pixels_are_as_opencv_reads_them) {
  const TempFolder folder;
  int seed = 0;
  for (const auto& [name, type] : {std::pair<std::string, int>{"a.png", CV_8UC1},
                                   {"b.png", CV_8UC3},
                                   {"c.png", CV_16UC1},
                                   {"d.png", CV_8UC4},
                                   {"e.jpg", CV_8UC3},
                                   {"f.pgm", CV_8UC1},
                                   {"g.tiff", CV_16UC1}}) {
    folder.writeImage(name, ++seed, type);
    const auto dataset = deliver(withFiles(folder, {name, name}), {2, 4});
    const cv::Mat expected = cv::imread(folder / name, cv::IMREAD_UNCHANGED);
    while (const auto frame = dataset->next()) {
      EXPECT_TRUE(reading_case::isSame(frame->images.at(0).image, expected)) << name;
      const auto kind = frame->images[0].kind;
      EXPECT_EQ(kind, expected.channels() == 1   ? gslam::ImageKind::grey
                      : expected.channels() == 3 ? gslam::ImageKind::bgr
                                                 : gslam::ImageKind::bgra);
    }
  }
}

TEST(reading_images, a_damaged_one_is_an_error_and_the_next_one_comes) {
  const TempFolder folder;
  folder.writeImage("0.png", 0);
  folder.writeImage("1.png", 1);
  folder.writeImage("3.png", 3, CV_8UC1, 17);
  folder.writeImage("4.png", 4);
  const std::string whole = reading_case::textOf(folder / "1.png");
  folder.write("1.png", whole.substr(0, whole.size() / 2));
  folder.write("2.png", "");
  const auto dataset =
      deliver(withFiles(folder, {"0.png", "1.png", "2.png", "3.png", "4.png", "5.png"}), {2, 4});
  EXPECT_NE(dataset->next(), nullptr);
  for (const char* text :
       {"1.png: ends early", "2.png: is empty", "3.png: is 17 x 12, but the camera"}) {
    const std::string message = messageOf([&] { (void)dataset->next(); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  }
  EXPECT_EQ(dataset->next()->id, 4U);
  const std::string message = messageOf([&] { (void)dataset->next(); });
  EXPECT_NE(message.find("5.png"), std::string::npos) << message;
  EXPECT_EQ(dataset->next(), nullptr);
}

TEST(reading_images, only_depth_is_depth) {
  const TempFolder folder;
  folder.writeImage("colour.png", 0, CV_8UC3);
  folder.writeImage("depth.png", 0, CV_16UC1);
  for (const char* name : {"colour.png", "depth.png"}) {
    Sequence sequence;
    sequence.stamps = {0};
    sequence.info.sensors.cameras = {namedCamera("depth")};
    sequence.info.sensors.cameras[0].kind = gslam::ImageKind::depth;
    const std::string message = messageOf([&] {
      loadImageFiles(sequence, {FileTree::open(folder.path()), {name}});
    });
    EXPECT_EQ(message.empty(), name[0] == 'd') << message;
  }
}

// A few bytes that ask for 80000 x 80000 pixels.
TEST(reading_images, a_bomb_is_refused_by_its_head) {
  const TempFolder folder;
  folder.writeImage("0.png", 0);
  std::string bomb = reading_case::textOf(folder / "0.png");
  for (const std::size_t at : {16U, 20U}) bomb.replace(at, 4, std::string("\x00\x01\x38\x80", 4));
  folder.write("1.png", bomb);
  const auto dataset = deliver(withFiles(folder, {"0.png", "1.png"}), {1, 2});
  (void)dataset->next();
  const std::string message = messageOf([&] { (void)dataset->next(); });
  EXPECT_NE(message.find("80000 x 80000"), std::string::npos) << message;
  EXPECT_THROW(withFiles(folder, {"1.png"}), gslam::FileError);
}

TEST(reading_images, a_calibration_for_another_size_is_refused) {
  const TempFolder folder;
  folder.writeImage("0.png", 0);
  Sequence sequence;
  sequence.stamps = {0};
  sequence.info.sensors.cameras = {namedCamera("one")};
  sequence.info.sensors.cameras[0].camera = cameraOfWords("pinhole 640x480 500 500 320 240");
  const std::string message = messageOf([&] {
    loadImageFiles(sequence, {FileTree::open(folder.path()), {"0.png"}});
  });
  EXPECT_NE(message.find("calibration of camera 'one' is for 640 x 480"), std::string::npos);
}

// --- cameras in one line ---

TEST(camera_words, reads_lines_of_people_and_of_info) {
  const gslam::Camera camera = cameraOfWords("radtan 640x480 500 501 320 240 0.1 -0.2 0.001 0");
  EXPECT_EQ(camera.width(), 640);
  EXPECT_EQ(camera.parameter("fy"), 501);
  EXPECT_EQ(cameraOfWords("pinhole 640 480 5 5 3 2"), cameraOfWords("pinhole 640 x 480 5 5 3 2"));
  std::ostringstream printed;
  printed << camera;
  EXPECT_EQ(cameraOfWords(printed.str()), camera);
}

TEST(camera_words, says_what_is_wrong) {
  for (const char* words :
       {"", "pinhole", "pinhole 640x480", "pinhole 640x480 1 2 3", "pinhole 0x480 1 1 1 1",
        "pinhole 640x480 1 1 1 a", "nothing 640x480 1 1 1 1", "pinhole 640x480 fx 1 1 1 1",
        "pinhole 6e99x480 1 1 1 1", "pinhole x 640 480 1 1 1 1"}) {
    EXPECT_THROW(cameraOfWords(words), gslam::ArgumentError) << words;
  }
}

}  // namespace
