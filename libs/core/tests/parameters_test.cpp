#include <gmock/gmock.h>
#include <gslam/core/parameters.h>

#include <string>

namespace {

using gslam::completeParameters;
using gslam::Svar;
using gslam::SvarError;

Svar defaults() {
  return Svar::object({{"features", 1000},
                       {"scale", 1.2},
                       {"name", "orb"},
                       {"loop", Svar::object({{"enabled", true}, {"score", 0.5}})},
                       {"extra", Svar::object()},
                       {"any", nullptr}});
}

std::string parameterProblem(const Svar& given) {
  try {
    completeParameters(defaults(), given);
  } catch (const SvarError& error) {
    return error.what();
  }
  return "none";
}

TEST(Parameters, LaysWhatIsGivenOverTheDefaults) {
  const Svar given = Svar::object({{"scale", 2},
                                   {"loop", Svar::object({{"enabled", false}})},
                                   {"extra", Svar::object({{"x", 1}})},
                                   {"any", "thing"}});
  const Svar all = completeParameters(defaults(), given);
  EXPECT_EQ(all.get<int>("features"), 1000);
  EXPECT_EQ(all.get<double>("scale"), 2);
  EXPECT_FALSE(all.get<bool>("loop.enabled"));
  EXPECT_EQ(all.get<double>("loop.score"), 0.5);
  EXPECT_EQ(all.get<int>("extra.x"), 1);
  EXPECT_EQ(all.get<std::string>("any"), "thing");
}

TEST(Parameters, DefaultsStayAsTheyWere) {
  Svar standard = defaults();
  Svar all = completeParameters(standard, Svar());
  all.set("loop.score", 1.0);
  EXPECT_EQ(standard, defaults());
}

TEST(Parameters, SaysWhatIsWrong) {
  EXPECT_EQ(parameterProblem(Svar::object({{"feature", 1}})),
            "feature: is no parameter of it, did you mean features?");
  EXPECT_EQ(parameterProblem(Svar::object({{"features", 1.5}})),
            "features: expected int, found double");
  EXPECT_EQ(parameterProblem(Svar::object({{"name", 1}})), "name: expected string, found int");
  EXPECT_EQ(parameterProblem(Svar::object({{"loop", Svar::object({{"scores", 1}})}})),
            "loop.scores: is no parameter of it, did you mean score?");
  EXPECT_EQ(parameterProblem(Svar::object({{"loop", true}})), "loop: expected object, found bool");
  EXPECT_EQ(parameterProblem(Svar::object({{"zzzzzz", 1}})), "zzzzzz: is no parameter of it");
  EXPECT_NE(parameterProblem(5), "none");
}

TEST(Parameters, NullIsNoParameter) {
  EXPECT_EQ(completeParameters(Svar(), Svar()), Svar::object());
  EXPECT_THROW(completeParameters(Svar(), Svar::object({{"x", 1}})), SvarError);
}

}  // namespace
