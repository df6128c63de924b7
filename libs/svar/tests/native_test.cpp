// Native objects: shared by all handles, found again as what they were.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <type_traits>
#include <unordered_set>
#include <vector>

#include "error_text.h"

namespace {

using gslam::Svar;
using gslam::SvarError;
using gslam::SvarType;

struct Image {
  virtual ~Image() = default;
  int width = 640;
};
struct DepthImage : Image {};

// Only shared ownership makes a native object.
static_assert(!std::is_convertible<Image, Svar>::value, "");
static_assert(!std::is_convertible<Image*, Svar>::value, "");
static_assert(!std::is_convertible<std::unique_ptr<Image>, Svar>::value, "");
static_assert(!std::is_convertible<std::weak_ptr<Image>, Svar>::value, "");
static_assert(std::is_convertible<std::shared_ptr<Image>, Svar>::value, "");

TEST(Native, SharesTheObject) {
  const auto image = std::make_shared<Image>();
  const Svar value = image;
  EXPECT_EQ(value.type(), SvarType::native);
  EXPECT_STREQ(value.typeName(), "native");
  EXPECT_EQ(value.as<std::shared_ptr<Image>>(), image);
  value.as<std::shared_ptr<Image>>()->width = 320;
  EXPECT_EQ(image->width, 320);
  EXPECT_TRUE(value.is<std::shared_ptr<Image>>());
}

TEST(Native, IsSharedByClonesAndFrozenValues) {
  const auto image = std::make_shared<Image>();
  const Svar config = Svar::object({{"image", image}});
  EXPECT_EQ(config.clone().get<std::shared_ptr<Image>>("image"), image);
  EXPECT_EQ(config.frozen().get<std::shared_ptr<Image>>("image"), image);
  EXPECT_EQ(config.clone(), config);
}

TEST(Native, IsReleasedWithItsLastHandle) {
  auto image = std::make_shared<Image>();
  const std::weak_ptr<Image> watch = image;
  Svar config = Svar::object({{"list", Svar::array({image, image})}});
  image.reset();
  EXPECT_TRUE(config.erase("list.0"));
  EXPECT_FALSE(watch.expired());
  config = nullptr;
  EXPECT_TRUE(watch.expired());
}

TEST(Native, IsFoundAsWhatItWasOnly) {
  const Svar value = std::make_shared<DepthImage>();
  EXPECT_TRUE(value.is<std::shared_ptr<DepthImage>>());
  EXPECT_TRUE(value.is<std::shared_ptr<const DepthImage>>());
  EXPECT_FALSE(value.is<std::shared_ptr<Image>>());  // its base class
  EXPECT_FALSE(value.is<std::shared_ptr<int>>());
  EXPECT_FALSE(value.is<int>());
  EXPECT_FALSE(value.is<std::string>());
  const Svar base = std::shared_ptr<Image>(std::make_shared<DepthImage>());
  EXPECT_TRUE(base.is<std::shared_ptr<Image>>());
  EXPECT_FALSE(base.is<std::shared_ptr<DepthImage>>());
}

TEST(Native, StaysConst) {
  const std::shared_ptr<const Image> image = std::make_shared<Image>();
  const Svar value = image;
  EXPECT_EQ(value.as<std::shared_ptr<const Image>>(), image);
  EXPECT_FALSE(value.is<std::shared_ptr<Image>>());
}

TEST(Native, SaysWhatWasFoundAndAskedFor) {
  const Svar value = std::make_shared<const int>(3);
  EXPECT_EQ(errorText([&] { value.as<std::shared_ptr<int>>(); }),
            "expected native int, found native const int");
  EXPECT_EQ(errorText([&] { value.as<double>(); }), "expected double, found native const int");
  EXPECT_EQ(errorText([] { Svar(3).as<std::shared_ptr<const int>>(); }),
            "expected native const int, found int 3");
  EXPECT_EQ(errorText([&] { value.size(); }), "expected array or object, found native const int");
}

TEST(Native, NullPointersAreNull) {
  const Svar value = std::shared_ptr<Image>();
  EXPECT_TRUE(value.isNull());
  EXPECT_EQ(value.as<std::shared_ptr<Image>>(), nullptr);
  EXPECT_EQ(value.as<std::shared_ptr<int>>(), nullptr);
}

TEST(Native, MayBeAnyTypeEvenANumber) {
  EXPECT_EQ(*Svar(std::make_shared<int>(3)).as<std::shared_ptr<int>>(), 3);
  EXPECT_NE(Svar(std::make_shared<int>(3)), Svar(3));
  const auto value = std::make_shared<Svar>(Svar::array({1}));
  EXPECT_EQ(Svar(value).as<std::shared_ptr<Svar>>(), value);
  const std::shared_ptr<void> nameless = value;
  EXPECT_EQ(Svar(nameless).as<std::shared_ptr<void>>(), nameless);
}

TEST(Native, EqualsTheSameObjectOnly) {
  const auto image = std::make_shared<Image>();
  const std::shared_ptr<const Image> same = image;
  EXPECT_EQ(Svar(image), Svar(image));
  EXPECT_EQ(Svar(image), Svar(same));
  EXPECT_EQ(Svar(image).hash(), Svar(same).hash());
  EXPECT_NE(Svar(image), Svar(std::make_shared<Image>()));
  std::unordered_set<Svar> seen = {image, same, std::make_shared<Image>()};
  EXPECT_EQ(seen.size(), 2u);
}

TEST(Native, DiffersFromItsFirstMember) {
  struct Size {
    int width;
  };
  const auto size = std::make_shared<Size>();
  const std::shared_ptr<int> width(size, &size->width);
  EXPECT_NE(Svar(size), Svar(width));
}

TEST(Native, GoesThroughContainers) {
  const std::vector<std::shared_ptr<Image>> images = {std::make_shared<Image>(), nullptr};
  const Svar value = images;
  EXPECT_EQ(value.as<std::vector<std::shared_ptr<Image>>>(), images);
  EXPECT_TRUE(value[1].isNull());
  EXPECT_THROW(value.as<std::vector<std::shared_ptr<DepthImage>>>(), SvarError);
}

}  // namespace
