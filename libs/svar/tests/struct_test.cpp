// Own types: SvarTraits, and SvarFields for structs.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "error_text.h"

namespace {

// A type that is written as text.
struct Model {
  std::string name;
};

struct Camera {
  double fx = 500;
  std::vector<double> k = {0.5, 0.25};
  bool wide = false;
};

struct StereoCamera : Camera {
  double baseline = 0.5;
};

struct Rig {
  std::map<std::string, Camera> cameras;
  std::vector<Rig> parts;  // the struct inside itself
  gslam::Svar notes;
};

struct OddNames {
  int dotted = 1;
  int slashed = 2;
  int empty = 3;
  int dash = 4;
};

// Can be moved only.
struct Holder {
  std::unique_ptr<int> number;
};

}  // namespace

namespace gslam {

template <>
struct SvarTraits<Model> {
  static std::string name() { return "model"; }
  static Svar toSvar(const Model& model) { return model.name; }
  static Model fromSvar(const Svar& value) {
    const std::string name = value.as<std::string>();
    if (name.empty()) throw SvarError("", "a model has a name");
    return {name};
  }
};

template <>
struct SvarTraits<Camera> : SvarFields<Camera> {
  template <class Visit>
  static void fields(Visit& visit) {
    visit("fx", &Camera::fx);
    visit("k", &Camera::k);
    visit("wide", &Camera::wide);
  }
};

template <>
struct SvarTraits<StereoCamera> : SvarFields<StereoCamera> {
  template <class Visit>
  static void fields(Visit& visit) {
    SvarTraits<Camera>::fields(visit);
    visit("baseline", &StereoCamera::baseline);
  }
};

template <>
struct SvarTraits<Rig> : SvarFields<Rig> {
  static std::string name() { return "rig"; }
  template <class Visit>
  static void fields(Visit& visit) {
    visit("cameras", &Rig::cameras);
    visit("parts", &Rig::parts);
    visit("notes", &Rig::notes);
  }
};

template <>
struct SvarTraits<OddNames> : SvarFields<OddNames> {
  template <class Visit>
  static void fields(Visit& visit) {
    visit("a.b", &OddNames::dotted);
    visit("a/~b", &OddNames::slashed);
    visit("", &OddNames::empty);
    visit("-", &OddNames::dash);
  }
};

template <>
struct SvarTraits<Holder> {
  static Holder fromSvar(const Svar& value) {
    Holder holder;
    holder.number.reset(new int(value.as<int>()));
    return holder;
  }
};

}  // namespace gslam

namespace {

using gslam::Svar;
using gslam::SvarError;

TEST(OwnTraits, ConvertBothWays) {
  const Svar value = Model{"pinhole"};
  EXPECT_EQ(value, "pinhole");
  EXPECT_EQ(value.as<Model>().name, "pinhole");
  EXPECT_EQ(Svar::object({{"m", Model{"a"}}}).get<Model>("m").name, "a");
  EXPECT_EQ(Svar().get<Model>("m", Model{"b"}).name, "b");
  EXPECT_TRUE(value.is<Model>());
  EXPECT_FALSE(Svar("").is<Model>());
}

TEST(OwnTraits, ErrorsHaveThePathInFront) {
  const Svar config = Svar::object({{"m", Svar::array({"a", ""})}});
  EXPECT_EQ(errorText([&] { config.get<std::vector<Model>>("m"); }), "m.1: a model has a name");
  EXPECT_EQ(errorText([&] { config.get<Model>("n"); }),
            "n: expected model, found nothing: no \"n\" in the value (object of 1)");
}

TEST(OwnTraits, MayReadMoveOnlyTypes) {
  EXPECT_EQ(*Svar(3).as<Holder>().number, 3);
  EXPECT_EQ(Svar::array({1, 2}).as<std::vector<Holder>>().size(), 2u);
  const Svar f = Svar::function([](Holder holder) { return *holder.number; });
  EXPECT_EQ(f(7), 7);
}

TEST(Fields, AreMembersInTheirOrder) {
  const Svar value = Camera();
  EXPECT_EQ(value, Svar::object({{"fx", 500.0}, {"k", Svar::array({0.5, 0.25})}, {"wide", false}}));
  EXPECT_EQ(value.members()[0].first, "fx");
  EXPECT_EQ(value.members()[2].first, "wide");
}

TEST(Fields, ThatAreMissingKeepTheirDefault) {
  const Camera camera = Svar::object({{"wide", true}, {"fx", 1}}).as<Camera>();
  EXPECT_EQ(camera.fx, 1.0);
  EXPECT_TRUE(camera.wide);
  EXPECT_EQ(camera.k, Camera().k);
  EXPECT_EQ(Svar::object().as<Camera>().fx, 500.0);
}

TEST(Fields, UnknownMembersAreErrors) {
  const std::string text = errorText([] { Svar::object({{"fx", 1}, {"fY", 2}}).as<Camera>(); });
  EXPECT_EQ(text.find("fY: is no field of "), 0u) << text;
  EXPECT_NE(text.find("Camera, which has fx, k, wide"), std::string::npos) << text;
  EXPECT_EQ(errorText([] {
              Svar::object({{"left", Svar::object({{"x", 2}})}})
                  .get<std::map<std::string, Camera>>("left");
            }).find("left.x: "),
            0u);
}

TEST(Fields, OfTheWrongTypeAreErrorsWithTheirPath) {
  const Svar value = Svar::object({{"fx", 1}, {"k", Svar::array({0.5, "x"})}});
  EXPECT_EQ(errorText([&] { value.as<Camera>(); }), "k.1: expected double, found string \"x\"");
  EXPECT_EQ(errorText([&] {
              Svar::object({{"c", value}}).get<Camera>("c");
            }),
            "c.k.1: expected double, found string \"x\"");
  EXPECT_EQ(errorText([] { Svar(3).as<Rig>(); }).find("expected "), 0u);
  EXPECT_THROW(Svar().as<Camera>(), SvarError);
  EXPECT_THROW(Svar::array().as<Camera>(), SvarError);
}

TEST(Fields, MayBeStructsInsideContainersAndThemselves) {
  Rig rig;
  rig.cameras["left"].fx = 2;
  rig.parts.resize(2);
  rig.parts[1].cameras["right"].wide = true;
  rig.notes = Svar::array({1, "two"});
  const Svar value = rig;
  EXPECT_EQ(value.get<double>("cameras.left.fx"), 2.0);
  EXPECT_TRUE(value.get<bool>("parts.1.cameras.right.wide"));
  const Rig back = value.as<Rig>();
  EXPECT_EQ(Svar(back), value);
  EXPECT_EQ(back.parts.size(), 2u);
  EXPECT_EQ(errorText([&] {
              Svar wrong = value.clone();
              wrong.set("parts.1.cameras.right.k", 3);
              wrong.as<Rig>();
            }),
            "parts.1.cameras.right.k: expected array of double, found int 3");
}

TEST(Fields, MayBeInherited) {
  const Svar value = StereoCamera();
  EXPECT_EQ(value.size(), 4u);
  EXPECT_EQ(value.members()[0].first, "fx");
  EXPECT_EQ(Svar::object({{"fx", 7}, {"baseline", 1}}).as<StereoCamera>().fx, 7.0);
}

TEST(Fields, MayHaveAnyName) {
  const Svar value = OddNames();
  EXPECT_EQ(value, Svar::object({{"a.b", 1}, {"a/~b", 2}, {"", 3}, {"-", 4}}));
  EXPECT_EQ(value.as<OddNames>().slashed, 2);
  EXPECT_EQ(Svar::object({{"", 7}}).as<OddNames>().empty, 7);
}

TEST(Fields, StructsAreArgumentsAndResults) {
  const Svar f = Svar::function([](Camera camera, const Model& model) {
    camera.wide = model.name == "wide";
    return camera;
  });
  EXPECT_TRUE(f(Camera(), "wide").get<bool>("wide"));
  EXPECT_EQ(errorText([&] {
              f(Svar::object({{"fx", "x"}}), "wide");
            }),
            "argument 1: fx: expected double, found string \"x\"");
}

}  // namespace
