// The members of an object against a plain list of pairs, in small and large.
#include <gslam/svar/ordered_map.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using Map = gslam::detail::OrderedMap<int>;
using List = std::vector<Map::Member>;

// What OrderedMap does, one name after the other.
struct Reference {
  List::iterator at(const std::string& name) {
    return std::find_if(list.begin(), list.end(),
                        [&](const Map::Member& member) { return member.first == name; });
  }
  List list;
};

void expectSame(const Map& map, Reference& reference) {
  ASSERT_EQ(map.members(), reference.list);
  for (const Map::Member& member : reference.list) {
    const int* const found = map.find(member.first);
    ASSERT_NE(found, nullptr) << member.first;
    ASSERT_EQ(*found, member.second) << member.first;
  }
}

std::size_t below(std::mt19937& engine, std::size_t end) {
  return engine() % end;
}

TEST(OrderedMap, InsertsAndErasesAsAListDoes) {
  for (const std::size_t names : {1u, 5u, 8u, 9u, 10u, 17u, 40u, 1000u}) {
    SCOPED_TRACE(names);
    std::mt19937 engine(static_cast<unsigned>(names));
    Map map;
    Reference reference;
    for (int step = 0; step < 3000; ++step) {
      const std::string name = "name" + std::to_string(below(engine, names));
      const auto at = reference.at(name);
      const bool there = at != reference.list.end();
      ASSERT_EQ(map.find(name) != nullptr, there);
      if (!there) {
        ASSERT_EQ(map.insert(name, step), step);
        reference.list.emplace_back(name, step);
      } else if (below(engine, 2) == 0) {
        *map.find(name) = step;
        at->second = step;
      } else {
        ASSERT_TRUE(map.erase(name));
        ASSERT_FALSE(map.erase(name));
        reference.list.erase(at);
      }
      if (step % 50 == 0) expectSame(map, reference);
    }
    expectSame(map, reference);
    while (!reference.list.empty()) {
      const std::size_t i = below(engine, reference.list.size());
      ASSERT_TRUE(map.erase(reference.list[i].first));
      reference.list.erase(reference.list.begin() + static_cast<std::ptrdiff_t>(i));
      if (reference.list.size() % 20 == 0) expectSame(map, reference);
    }
    ASSERT_TRUE(map.members().empty());
  }
}

TEST(OrderedMap, AssignsListsOfAllSizes) {
  for (std::size_t size = 0; size <= 1000; size += size < 40 ? 1 : 97) {
    Reference reference;
    for (std::size_t i = 0; i < size; ++i) {
      reference.list.emplace_back(std::to_string(i * 7919), static_cast<int>(i));
    }
    Map map;
    map.insert("old", 1);
    EXPECT_EQ(map.assign(reference.list), Map::Repeat(size, size));
    expectSame(map, reference);
    EXPECT_EQ(map.find("old"), nullptr);
    map.insert("new", 7);
    reference.list.emplace_back("new", 7);
    expectSame(map, reference);
  }
}

TEST(OrderedMap, FindsTheFirstNameThatRepeats) {
  for (const std::size_t size : {2u, 8u, 9u, 100u}) {
    for (std::size_t later = 1; later < size; later += size / 8 + 1) {
      for (std::size_t earlier = 0; earlier < later; earlier += size / 8 + 1) {
        List list;
        for (std::size_t i = 0; i < size; ++i) list.emplace_back(std::to_string(i), 0);
        list[later].first = list[earlier].first;
        list.back().first = list[earlier].first;  // one more, which is not the first
        Map map;
        EXPECT_EQ(map.assign(list), Map::Repeat(earlier, later));
      }
    }
  }
}

TEST(OrderedMap, KeepsTheLastValueAtTheFirstPlace) {
  std::mt19937 engine(7);
  for (const std::size_t size : {1u, 3u, 8u, 9u, 20u, 1000u}) {
    for (std::size_t names = 1; names <= size; names = 2 * names + 1) {
      List list;
      Reference reference;
      for (std::size_t i = 0; i < size; ++i) {
        const std::string name = "n" + std::to_string(below(engine, names));
        list.emplace_back(name, static_cast<int>(i));
        const auto at = reference.at(name);
        if (at != reference.list.end()) {
          at->second = static_cast<int>(i);
        } else {
          reference.list.push_back(list.back());
        }
      }
      Map map;
      map.assign(list);
      map.keepLast();
      expectSame(map, reference);
    }
  }
}

TEST(OrderedMap, TellsNamesThatDifferInOneByte) {
  for (std::size_t length = 0; length <= 40; ++length) {
    SCOPED_TRACE(length);
    const std::string base(length, 'x');
    Map map;
    Reference reference;
    const auto add = [&](const std::string& name) {
      ASSERT_EQ(map.find(name), nullptr) << name;
      const int value = static_cast<int>(reference.list.size());
      map.insert(name, value);
      reference.list.emplace_back(name, value);
    };
    add(base);
    add(base + 'x');
    add(base + '\0');
    for (std::size_t i = 0; i < length; ++i) {
      for (const char byte : {'y', '\0', '\x80', '\xFF', 'X'}) {
        std::string name = base;
        name[i] = byte;
        add(name);
      }
    }
    expectSame(map, reference);
  }
}

// Differences that a hash by xor and multiplication takes back again, whatever it begins with.
TEST(OrderedMap, NamesBuiltToCollideHaveOtherHashes) {
  const std::size_t pairs = 12;
  std::set<std::uint64_t> hashes;
  for (std::size_t bits = 0; bits < std::size_t(1) << pairs; ++bits) {
    std::string name(16 * pairs + 1, 'a');
    for (std::size_t i = 0; i < pairs; ++i) {
      if ((bits >> i & 1u) == 0) continue;
      for (const std::size_t at : {7u, 11u, 15u}) name[16 * i + at] = 'a' ^ '\x80';
    }
    hashes.insert(gslam::detail::hashBytes(name.data(), name.size(), 42));
  }
  EXPECT_EQ(hashes.size(), std::size_t(1) << pairs);
}

TEST(OrderedMap, CopiesAreIndependent) {
  Map map;
  for (int i = 0; i < 20; ++i) map.insert(std::to_string(i), i);
  const Map copy = map;
  EXPECT_TRUE(map.erase("3"));
  map.insert("20", 20);
  EXPECT_EQ(copy.members().size(), 20u);
  EXPECT_EQ(*copy.find("3"), 3);
  EXPECT_EQ(copy.find("20"), nullptr);
  const Map moved = std::move(map);
  EXPECT_EQ(*moved.find("20"), 20);
}

}  // namespace
