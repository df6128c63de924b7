#include "loops/place_index.h"

#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/train.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using made::kStep;
using made::Random;
using visual::PlaceIndex;
using visual::SimilarPlace;
using visual::View;
using Views = std::vector<std::shared_ptr<const View>>;

// Views on the circle, each with noise of its own.
Views viewsOf(const made::Room& room, int count, std::uint64_t seed) {
  const visual::Eye eye = made::makeEye(visual::SensorKind::mono);
  Random random(seed);
  Views views;
  for (int i = 0; i < count; ++i) {
    views.push_back(
        made::look(room, eye, made::cameraOnCircle(kStep * i), {}, random, std::uint64_t(i)).view);
  }
  return views;
}

void addAll(PlaceIndex& index, const Views& views) {
  for (std::size_t i = 0; i < views.size(); ++i) index.add(KeyframeId(i), views[i]);
}

class PlaceIndexTest : public testing::Test {
 protected:
  const made::Room room = made::makeRoom(1);
  visual::LoopOptions options;
};

TEST_F(PlaceIndexTest, FindsThePlaceOfAView) {
  PlaceIndex index(options, 1);
  addAll(index, viewsOf(room, 60, 2));
  const Views again = viewsOf(room, 60, 3);
  for (std::size_t i = 0; i < again.size(); i += 7) {
    const std::vector<SimilarPlace> found = index.similar(*again[i], 5);
    ASSERT_EQ(found.size(), 5U);
    EXPECT_LE(std::abs(int(found[0].keyframe) - int(i)), 1) << i;
    EXPECT_GE(found[0].score, found[4].score);
    EXPECT_DOUBLE_EQ(index.score(found[2].keyframe, *again[i]), found[2].score);
    // The other side of the room looks different.
    EXPECT_LT(index.score(KeyframeId((i + 30) % 60), *again[i]), 0.5 * found[0].score);
  }
}

TEST_F(PlaceIndexTest, HasNoScoresBeforeTheFirstTraining) {
  PlaceIndex index(options, 1);
  const Views views = viewsOf(room, 12, 2);
  for (std::uint32_t i = 0; i < 11; ++i) index.add(KeyframeId(i), views[i]);
  EXPECT_FALSE(index.hasVocabulary());
  const std::vector<SimilarPlace> all = index.similar(*views[0], 3);
  ASSERT_EQ(all.size(), 11U);
  EXPECT_EQ(all.front().keyframe, KeyframeId(10));
  EXPECT_EQ(all.back().keyframe, KeyframeId(0));
  EXPECT_EQ(all.front().score, 0);
  EXPECT_EQ(index.score(KeyframeId(0), *views[0]), 0);
  index.add(KeyframeId(11), views[11]);
  EXPECT_TRUE(index.hasVocabulary());
  EXPECT_NEAR(index.score(KeyframeId(0), *views[0]), 1, 1e-12);
}

TEST_F(PlaceIndexTest, LearnsNewWordsWhenThereAreManyMoreKeyframes) {
  PlaceIndex index(options, 1);
  const Views views = viewsOf(room, 48, 2);
  addAll(index, Views(views.begin(), views.end() - 1));
  const double before = index.score(KeyframeId(44), *views[46]);
  index.add(KeyframeId(47), views[47]);
  EXPECT_NE(index.score(KeyframeId(44), *views[46]), before);
  EXPECT_NEAR(index.score(KeyframeId(47), *views[47]), 1, 1e-12);
}

TEST_F(PlaceIndexTest, ForgetsWhatWasRemoved) {
  PlaceIndex index(options, 1);
  const Views views = viewsOf(room, 50, 2);
  addAll(index, Views(views.begin(), views.begin() + 20));
  index.remove(KeyframeId(5));
  index.remove(KeyframeId(5));
  index.remove(KeyframeId(1000));
  for (std::uint32_t i = 20; i < 50; ++i) index.add(KeyframeId(i), views[i]);
  for (const SimilarPlace& place : index.similar(*views[5], 100)) {
    EXPECT_NE(place.keyframe, KeyframeId(5));
  }
  EXPECT_EQ(index.score(KeyframeId(5), *views[5]), 0);
  EXPECT_EQ(index.similar(*views[5], 1)[0].keyframe, KeyframeId(6));
}

TEST_F(PlaceIndexTest, SaysTheSameOfTheSame) {
  PlaceIndex one(options, 7), other(options, 7);
  const Views views = viewsOf(room, 50, 2);
  addAll(one, views);
  addAll(other, views);
  for (const auto& view : views) {
    const std::vector<SimilarPlace> a = one.similar(*view, 10), b = other.similar(*view, 10);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].keyframe, b[i].keyframe);
      EXPECT_EQ(a[i].score, b[i].score);
    }
  }
}

TEST_F(PlaceIndexTest, WaitsForFeatures) {
  PlaceIndex index(options, 1);
  const visual::Eye eye = made::makeEye(visual::SensorKind::mono);
  Random random(1);
  const Views views = viewsOf(room, 12, 2);
  const made::Seen black = made::look(made::Room(), eye, gslam::SE3d(), {}, random);
  for (std::uint32_t i = 0; i < 20; ++i) index.add(KeyframeId(i), black.view);
  EXPECT_FALSE(index.hasVocabulary());
  // Too few of them would give words that count nothing: all images have them.
  for (std::uint32_t i = 0; i < 11; ++i) index.add(KeyframeId(20 + i), views[i]);
  EXPECT_FALSE(index.hasVocabulary());
  index.add(KeyframeId(31), views[11]);
  EXPECT_TRUE(index.hasVocabulary());
  EXPECT_TRUE(index.similar(*black.view, 10).empty());
  EXPECT_EQ(index.similar(*views[3], 1).at(0).keyframe, KeyframeId(23));
}

TEST_F(PlaceIndexTest, KeepsNoViews) {
  PlaceIndex index(options, 1);
  Views views = viewsOf(room, 15, 2);
  addAll(index, views);
  const std::weak_ptr<const View> first = views[0];
  views.clear();
  EXPECT_TRUE(first.expired());
}

TEST_F(PlaceIndexTest, ReadsAVocabularyFromAFile) {
  const Views views = viewsOf(room, 20, 2);
  std::vector<gslam::Descriptors> rows;
  for (const auto& view : views) {
    rows.push_back(gslam::binaryDescriptors(view->descriptors().bytes(), view->size(), 32));
  }
  gslam::TrainingOptions training;
  training.depth = 3;
  options.vocabulary =
      testing::TempDir() + "slam_visual_" + std::to_string(getpid()) + "_places.gvoc";
  saveVocabulary(gslam::trainVocabulary(gslam::Span<const gslam::Descriptors>(rows), training),
                 options.vocabulary);
  PlaceIndex index(options, 1);
  EXPECT_TRUE(index.hasVocabulary());
  EXPECT_TRUE(index.similar(*views[0], 5).empty());
  index.add(KeyframeId(3), views[3]);
  EXPECT_EQ(index.similar(*views[3], 5).at(0).keyframe, KeyframeId(3));

  // Of descriptors of another size.
  const auto content = std::make_shared<gslam::KeyframeContent>();
  content->features.resize(1);
  content->descriptors = gslam::Image(61, 1, gslam::PixelType::u8);
  const auto other = std::make_shared<View>();
  other->content = content;
  EXPECT_THROW(index.add(KeyframeId(4), other), gslam::ArgumentError);
  std::remove(options.vocabulary.c_str());
  EXPECT_THROW(PlaceIndex(options, 1), gslam::FileError);
}

// Some add and remove, some ask, while vocabularies are trained.
TEST_F(PlaceIndexTest, MayBeSharedByThreads) {
  PlaceIndex index(options, 1);
  const Views views = viewsOf(room, 60, 2);
  std::atomic<bool> is_over{false};
  std::atomic<std::size_t> answers{0};
  const auto ask = [&](std::size_t first) {
    for (std::size_t i = first; !is_over; i = (i + 1) % views.size()) {
      answers += index.similar(*views[i], 5).size();
      answers += index.score(KeyframeId(i), *views[i]) > 0 ? 1 : 0;
    }
  };
  std::thread one(ask, 0), two(ask, 30);
  std::thread adds([&] {
    for (std::uint32_t i = 30; i < 60; ++i) index.add(KeyframeId(i), views[i]);
  });
  for (std::uint32_t i = 0; i < 30; ++i) {
    index.add(KeyframeId(i), views[i]);
    if (i % 5 == 4) index.remove(KeyframeId(i - 2));
  }
  adds.join();
  is_over = true;
  one.join();
  two.join();
  EXPECT_GT(answers, 0U);
  for (std::uint32_t i = 0; i < 60; ++i) {
    const bool is_removed = i < 30 && i % 5 == 2;
    EXPECT_NEAR(index.score(KeyframeId(i), *views[i]), is_removed ? 0 : 1, 1e-12) << i;
  }
}

}  // namespace
