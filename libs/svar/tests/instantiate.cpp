// Instantiates the templates of GSLAM::svar; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/svar.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

#if __cplusplus >= 201703L
#include <optional>
#include <string_view>
#endif

using gslam::Svar;

namespace {

struct Lens {
  double fx = 1;
  std::vector<float> k;
};

struct Native {
  double sum = 0;
};

}  // namespace

namespace gslam {

template <>
struct SvarTraits<Lens> : SvarFields<Lens> {
  template <class Visit>
  static void fields(Visit& visit) {
    visit("fx", &Lens::fx);
    visit("k", &Lens::k);
  }
};

}  // namespace gslam

template <class T>
static bool throughAll(Svar& root, const T& value) {
  root.set("a.b", value);
  return root["a"]["b"].is<T>() && root.get<T>("a.b") == value &&
         root.get<T>("x", value) == value && root["a"]["b"].as<T>() == value;
}

template <class I>
static bool byIndex(const Svar& list) {
  return list[I(0)] == list[0];
}

static int doubled(int x) {
  return 2 * x;
}

static bool callAll(const std::string& text) {
  const auto native = std::make_shared<Native>();
  const Svar length =
      Svar::function([](const std::string& s, std::size_t n) { return s.size() + n; });
  const Svar change = Svar::function([](Native& n, const Lens& by) { n.sum += by.fx; });
  const Svar count = Svar::function([](gslam::Span<const Svar> args) { return args.size(); });
  std::string own = text;
  const Svar next = Svar::function([own]() mutable -> std::string& { return own += "x"; });
  const std::function<Svar(std::vector<double> &&)> front = [](std::vector<double>&& list) {
    return Svar(list.empty() ? 0.0 : list.front());
  };
  change(native, Lens());
  return length(text, 1).is<int>() && count(1, 2.0, "three").as<int>() == 3 &&
         next().is<std::string>() && Svar::function(front)(std::vector<int>{1}).is<double>() &&
         Svar::function(doubled).apply(std::vector<Svar>{2}) == 4 && !change.signature().empty() &&
         Svar(native).as<std::shared_ptr<const Native>>()->sum > 0;
}

static bool convertAll(Svar& root, const std::string& text) {
  root.set("map", std::map<std::string, std::set<int>>{{text, {1, 2}}});
  root.set("tuple", std::make_tuple(1, text, std::array<float, 2>{{1, 2}}));
  root.set("bytes", Svar::binary(text.data(), text.size()));
  root.set("camera", Lens());
  bool good =
      root.get<std::map<std::string, std::vector<double>>>("map").size() == 1 &&
      std::get<1>(root.get<std::tuple<short, std::string, std::vector<int>>>("tuple")) == text &&
      root.get<std::vector<std::uint8_t>>("bytes").size() == text.size() &&
      root.get<Lens>("camera").k.empty() && root.get<Lens>("none", Lens()).fx > 0;
#if __cplusplus >= 201703L
  root.set("/optional", std::optional<int>(3));
  good = good && root.get<std::optional<int>>("optional") == 3;
#endif
  root.erase("bytes");
  return good;
}

static bool compareAll(const Svar& a, const Svar& b) {
  const std::unordered_set<Svar> seen = {a, b, a.frozen()};
  return a.patched(a.diff(b)) == b && a.merged(b).hash() == b.hash() && seen.size() <= 2 &&
         a.frozen().isFrozen() && gslam::parseJson(gslam::printJson(a, 2)) == a;
}

bool instantiateSvar(const std::string& text);

bool instantiateSvar(const std::string& text) {
  Svar root = Svar::object({{"list", Svar::array({1, 2.5f, "three", nullptr, true})}});
  bool good = throughAll<bool>(root, true) && throughAll<signed char>(root, 1) &&
              throughAll<std::uint8_t>(root, 1) && throughAll<short>(root, 1) &&
              throughAll<std::uint16_t>(root, 1) && throughAll<int>(root, 1) &&
              throughAll<unsigned>(root, 1u) && throughAll<long>(root, 1) &&
              throughAll<unsigned long>(root, 1) && throughAll<long long>(root, 1) &&
              throughAll<unsigned long long>(root, 1) && throughAll<float>(root, 1) &&
              throughAll<double>(root, 1) && throughAll<std::string>(root, text) &&
              throughAll<Svar>(root, Svar(text));
  const Svar list = root["list"];
  good = good && byIndex<signed char>(list) && byIndex<std::uint8_t>(list) &&
         byIndex<short>(list) && byIndex<unsigned>(list) && byIndex<std::size_t>(list) &&
         byIndex<long long>(list) && root.contains(text);
#if __cplusplus >= 201703L
  good = good && root.contains(std::string_view("list.0"));
#endif
  for (const Svar& element : list) good = good && element == element.clone();
  for (const Svar::Member& member : root.members()) good = good && root.contains(member.first);
  Svar copy = root.clone();
  copy.push_back(1);
  copy.swap(root);
  good = good && callAll(text) && convertAll(copy, text) && compareAll(copy, root);
  return good && root != copy && root.erase("list.0") && root.type() == gslam::SvarType::object;
}
