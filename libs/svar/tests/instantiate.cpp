// Instantiates the templates of GSLAM::svar; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/svar.h>

#include <cstdint>
#include <string>

#if __cplusplus >= 201703L
#include <string_view>
#endif

using gslam::Svar;

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
  return good && root != copy && root.erase("list.0") && root.type() == gslam::SvarType::object;
}
