// Databases of bags, against score() of the query and each entry.
#include <gslam/vocabulary/database.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "random_bags.h"

namespace {

using gslam::BowDatabase;
using gslam::BowVector;
using gslam::FeatureVector;
using gslam::QueryOptions;
using gslam::QueryResult;
using gslam::Scoring;
using random_bags::bag;
using random_bags::normalized;
using random_bags::scorings;

using Bags = std::map<std::uint64_t, BowVector>;
using Results = std::vector<QueryResult>;

std::uint32_t commonWords(const BowVector& a, const BowVector& b) {
  std::vector<std::uint32_t> common;
  std::set_intersection(a.words.begin(), a.words.end(), b.words.begin(), b.words.end(),
                        std::back_inserter(common));
  return static_cast<std::uint32_t>(common.size());
}

// Everything is asked.
Results queryByBruteForce(Scoring scoring, const Bags& bags, const BowVector& query,
                          const QueryOptions& options) {
  Results results;
  for (const auto& entry : bags) {
    const std::uint32_t common = commonWords(query, entry.second);
    if (entry.first >= options.before_id || common == 0 || common < options.min_common_words) {
      continue;
    }
    const double s = score(scoring, query, entry.second);
    if (!std::isnan(options.worst_score) && isBetter(scoring, options.worst_score, s)) continue;
    results.push_back({entry.first, s, common});
  }
  std::stable_sort(results.begin(), results.end(), [&](const QueryResult& a, const QueryResult& b) {
    return isBetter(scoring, a.score, b.score);
  });
  if (options.count != 0 && results.size() > options.count) results.resize(options.count);
  return results;
}

void expectSame(const Results& results, const Results& expected) {
  ASSERT_EQ(results.size(), expected.size());
  EXPECT_TRUE(results == expected);  // to the last bit
}

// Images of a walk that comes back: neighbours have many words in common.
std::vector<BowVector> walk(std::mt19937& generator, Scoring scoring, std::size_t images,
                            std::size_t words, std::uint64_t word_count) {
  std::vector<BowVector> bags;
  for (std::size_t i = 0; i < images; ++i) {
    const BowVector like = i == 0 ? BowVector() : bags[i % 17 == 0 ? i / 2 : i - 1];
    bags.push_back(normalized(bag(generator, words, word_count, like, 60), scoring));
  }
  return bags;
}

// Node 2 i has the features i and i + 5.
FeatureVector someFeatures(std::uint32_t nodes) {
  FeatureVector features;
  for (std::uint32_t i = 0; i < nodes; ++i) {
    features.nodes.push_back(2 * i);
    features.begins.push_back(2 * i);
    features.features.push_back(i);
    features.features.push_back(i + 5);
  }
  if (nodes != 0) features.begins.push_back(2 * nodes);
  return features;
}

}  // namespace

TEST(database, finds_what_scores_best) {
  std::mt19937 generator(1);
  for (const Scoring scoring : scorings()) {
    BowDatabase database(scoring);
    Bags bags;
    for (const BowVector& bow : walk(generator, scoring, 150, 120, 4000)) {
      bags[database.add(bow)] = bow;
    }
    for (const std::size_t count : {0u, 1u, 2u, 10u, 149u, 150u, 1000u}) {
      QueryOptions options;
      options.count = count;
      options.before_id = count % 2 == 0 ? 100 : 1000;
      options.min_common_words = static_cast<std::uint32_t>(1 + count % 3 * 10);
      const BowVector& like = bags[generator() % bags.size()];
      const BowVector query = normalized(bag(generator, 130, 4000, like, 70), scoring);
      SCOPED_TRACE(gslam::scoringName(scoring));
      expectSame(database.query(query, options), queryByBruteForce(scoring, bags, query, options));
    }
  }
}

TEST(database, leaves_out_scores_that_are_worse) {
  std::mt19937 generator(2);
  for (const Scoring scoring : scorings()) {
    BowDatabase database(scoring);
    Bags bags;
    for (const BowVector& bow : walk(generator, scoring, 60, 50, 500)) {
      bags[database.add(bow)] = bow;
    }
    QueryOptions options;
    options.count = 0;
    const BowVector query = bags[33];
    const Results all = database.query(query, options);
    ASSERT_GT(all.size(), 20u);
    options.worst_score = all[10].score;
    const Results some = database.query(query, options);
    ASSERT_GE(some.size(), 11u);  // those with this very score are there
    EXPECT_LT(some.size(), all.size());
    expectSame(some, queryByBruteForce(scoring, bags, query, options));
  }
}

TEST(database, puts_the_lower_id_first_where_scores_are_the_same) {
  const BowVector same = {{3, 8}, {0.5, 0.5}}, other = {{3, 9}, {0.5, 0.5}};
  for (const Scoring scoring : scorings()) {
    BowDatabase database(scoring);
    for (int i = 0; i < 6; ++i) database.add(i % 3 == 1 ? other : same);  // 1 and 4 are other
    const auto idsOf = [](const Results& results) {
      std::vector<std::uint64_t> ids;
      for (const QueryResult& result : results) ids.push_back(result.id);
      return ids;
    };
    using Ids = std::vector<std::uint64_t>;
    EXPECT_EQ(idsOf(database.query(same)), (Ids{0, 2, 3, 5, 1, 4}));
    QueryOptions options;
    options.count = 3;
    EXPECT_EQ(idsOf(database.query(same, options)), (Ids{0, 2, 3}));
    EXPECT_EQ(idsOf(database.query(other, options)), (Ids{1, 4, 0}));
  }
}

TEST(database, knows_the_first_and_the_last_word_there_can_be) {
  BowDatabase database(Scoring::dot);
  database.add({{0, 0xFFFFFFFF}, {2, 3}});
  database.add({{0}, {1}});
  database.add({{0xFFFFFFFF}, {1}});
  database.add({{1, 0xFFFFFFFE}, {1, 1}});
  const Results expected = {{0, 13, 2}, {2, 3, 1}, {1, 2, 1}};
  EXPECT_TRUE(database.query({{0, 0xFFFFFFFF}, {2, 3}}) == expected);
}

TEST(database, finds_nothing_for_an_empty_bag_or_in_an_empty_database) {
  for (const Scoring scoring : scorings()) {
    BowDatabase database(scoring);
    EXPECT_TRUE(database.query({{1}, {1}}).empty());
    EXPECT_TRUE(database.empty());
    EXPECT_EQ(database.add(BowVector()), 0u);  // an image without features is one, too
    EXPECT_TRUE(database.query({{1}, {1}}).empty());
    database.add({{1}, {1}});
    EXPECT_TRUE(database.query(BowVector()).empty());
    EXPECT_TRUE(database.query({{2}, {1}}).empty());
    QueryOptions options;
    options.before_id = 0;
    EXPECT_TRUE(database.query({{1}, {1}}, options).empty());
  }
}

TEST(database, leaves_out_scores_that_are_no_numbers) {
  const double most = std::numeric_limits<double>::max();
  BowDatabase database(Scoring::chi_square);
  database.add({{1}, {most}});
  database.add({{1}, {1}});
  const Results found = database.query({{1}, {most}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, 1u);
}

TEST(database, keeps_what_it_was_given) {
  std::mt19937 generator(3);
  BowDatabase database;
  const BowVector bow = bag(generator, 100, 1000);
  const FeatureVector features = someFeatures(40);
  EXPECT_EQ(database.add(bow, features), 0u);
  EXPECT_EQ(database.add(BowVector()), 1u);
  EXPECT_EQ(database.bow(0), bow);
  EXPECT_EQ(database.features(0), features);
  EXPECT_TRUE(database.bow(1).empty());
  EXPECT_TRUE(database.features(1).empty());
  EXPECT_EQ(database.size(), 2u);
  EXPECT_TRUE(database.contains(1));
  EXPECT_FALSE(database.contains(2));
  EXPECT_THROW(database.bow(2), gslam::ArgumentError);
  EXPECT_THROW(database.features(2), gslam::ArgumentError);
}

TEST(database, never_gives_an_id_twice) {
  BowDatabase database;
  const BowVector bow = {{1}, {1}};
  for (std::uint64_t i = 0; i < 5; ++i) EXPECT_EQ(database.add(bow), i);
  EXPECT_TRUE(database.erase(4));
  EXPECT_EQ(database.add(bow), 5u);
  database.clear();
  EXPECT_TRUE(database.empty());
  EXPECT_TRUE(database.query(bow).empty());
  EXPECT_FALSE(database.contains(2));
  EXPECT_FALSE(database.erase(2));
  EXPECT_EQ(database.add(bow), 6u);
  EXPECT_EQ(database.ids(), std::vector<std::uint64_t>{6});
}

TEST(database, forgets_what_is_erased) {
  BowDatabase database;
  const BowVector bow = {{1}, {1}};
  for (int i = 0; i < 5; ++i) database.add(bow);
  EXPECT_TRUE(database.erase(2));
  EXPECT_FALSE(database.erase(2));
  EXPECT_FALSE(database.erase(99));
  EXPECT_EQ(database.size(), 4u);
  EXPECT_EQ(database.ids(), (std::vector<std::uint64_t>{0, 1, 3, 4}));
  EXPECT_THROW(database.bow(2), gslam::ArgumentError);
  EXPECT_EQ(database.query(bow).size(), 4u);
}

TEST(database, refuses_what_is_no_bag) {
  BowDatabase database;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<BowVector> bad = {{{1, 2}, {1}},     {{1}, {1, 2}},  {{2, 1}, {1, 1}},
                                      {{1, 1}, {1, 1}},  {{1}, {-1e-9}}, {{1}, {nan}},
                                      {{1}, {infinity}}, {{}, {1}}};
  for (const BowVector& bow : bad) {
    EXPECT_THROW(database.add(bow), gslam::ArgumentError);
    EXPECT_THROW(database.query(bow), gslam::ArgumentError);
  }
  EXPECT_EQ(database.nextId(), 0u);
  EXPECT_THROW(BowDatabase(static_cast<Scoring>(9)), gslam::ArgumentError);
}

TEST(database, refuses_features_that_do_not_fit_each_other) {
  BowDatabase database;
  const std::vector<FeatureVector> bad = {{{1}, {}, {}},
                                          {{1}, {0}, {}},
                                          {{1}, {0, 1, 1}, {7}},
                                          {{1}, {1, 1}, {7}},
                                          {{1}, {0, 2}, {7}},
                                          {{1}, {0, 1}, {7, 8}},
                                          {{}, {}, {7}},
                                          {{}, {0, 0}, {}},
                                          {{2, 1}, {0, 1, 2}, {7, 8}},
                                          {{1, 1}, {0, 1, 2}, {7, 8}},
                                          {{1, 2}, {0, 3, 2}, {7, 8}},
                                          {{1}, {0, 2}, {8, 7}},
                                          {{1}, {0, 2}, {8, 8}}};
  for (const FeatureVector& features : bad) {
    EXPECT_THROW(database.add(BowVector(), features), gslam::ArgumentError);
  }
  EXPECT_NO_THROW(database.add(BowVector(), {{1, 2}, {0, 0, 2}, {7, 8}}));  // a node without any
  EXPECT_EQ(database.features(database.add(BowVector(), {{}, {0}, {}})), FeatureVector());
}

// As who comes from DBoW writes it: 0 is a pointer, too.
TEST(database, is_not_made_of_numbers) {
  static_assert(!std::is_constructible<BowDatabase, int>::value, "a scoring");
  static_assert(!std::is_constructible<BowDatabase, std::nullptr_t>::value, "a scoring");
  static_assert(std::is_constructible<BowDatabase, Scoring>::value, "a scoring");
}

TEST(database, may_be_moved) {
  BowDatabase first(Scoring::l2);
  first.add({{1}, {1}});
  BowDatabase second = std::move(first);
  EXPECT_EQ(second.size(), 1u);
  first = BowDatabase(Scoring::dot);
  EXPECT_EQ(first.scoring(), Scoring::dot);
  EXPECT_EQ(second.scoring(), Scoring::l2);
}

// More entries than a segment has, of which some words are in all, most in few.
TEST(database, is_right_with_twenty_thousand_entries) {
  std::mt19937 generator(4);
  BowDatabase database(Scoring::l1);
  Bags bags;
  for (int i = 0; i < 20000; ++i) {
    BowVector bow = bag(generator, 3, 3000);
    bow.words.push_back(4000);
    bow.values.push_back(static_cast<double>(generator() % 7));
    normalize(bow, Scoring::l1);
    bags[database.add(bow)] = bow;
  }
  for (int round = 0; round < 6; ++round) {
    QueryOptions options;
    options.count = round % 2 == 0 ? 20 : 0;
    options.before_id = 4000 + 5000 * static_cast<std::uint64_t>(round);
    const BowVector& query = bags[generator() % bags.size()];
    expectSame(database.query(query, options),
               queryByBruteForce(Scoring::l1, bags, query, options));
  }
}

// Adds and erases at random, with more of the one or the other by turns: segments die, shrink and
// become one.
TEST(database, is_right_however_it_grows_and_shrinks) {
  std::mt19937 generator(5);
  for (const unsigned phase : {500u, 9000u}) {
    BowDatabase database(Scoring::dot);
    Bags bags;
    for (unsigned i = 0; i < 60000; ++i) {
      const bool grows = generator() % 100 < (i / phase % 2 == 0 ? 85u : 20u);
      if (grows || bags.empty()) {
        const BowVector bow = bag(generator, 2, 5000);
        bags[database.add(bow)] = bow;
      } else {
        const auto victim = bags.lower_bound(generator() % database.nextId());
        const std::uint64_t id = (victim == bags.end() ? bags.begin() : victim)->first;
        ASSERT_TRUE(database.erase(id));
        ASSERT_FALSE(database.erase(id));
        bags.erase(id);
      }
      ASSERT_EQ(database.size(), bags.size());
      if (i % 3000 != 0 || bags.empty()) continue;
      QueryOptions options;
      options.count = 30;
      const BowVector& query = bags.begin()->second;
      expectSame(database.query(query, options),
                 queryByBruteForce(Scoring::dot, bags, query, options));
      ASSERT_EQ(database.bow(bags.rbegin()->first), bags.rbegin()->second);
    }
    std::vector<std::uint64_t> ids;
    for (const auto& entry : bags) ids.push_back(entry.first);
    EXPECT_EQ(database.ids(), ids);
  }
}

namespace {

// With those that were erased.
std::size_t entriesInMemory(const gslam::detail::BowStore& store) {
  std::size_t count = 0;
  for (const auto& part : *store.view()) count += part.segment->count();
  return count;
}

std::shared_ptr<const gslam::detail::BowEntry> smallEntry(std::uint32_t word) {
  const auto entry = std::make_shared<gslam::detail::BowEntry>();
  entry->bow = {{word, word + 1}, {1, 1}};
  return entry;
}

}  // namespace

TEST(database, does_not_grow_with_what_was_erased) {
  gslam::detail::BowStore store;
  const std::uint64_t window = 100;  // the last images of a long way
  for (std::uint64_t i = 0; i < 20000; ++i) {
    store.add(smallEntry(static_cast<std::uint32_t>(i)));
    if (i >= window) {
      ASSERT_TRUE(store.erase(i - window));
    }
    ASSERT_LE(entriesInMemory(store), 2 * window + 2);
  }
  EXPECT_EQ(store.view()->size(), 1u);
  for (std::uint64_t i = 20000 - window; i < 20000; ++i) ASSERT_TRUE(store.erase(i));
  EXPECT_TRUE(store.view()->empty());
}

TEST(database, brings_together_what_is_left_of_many_entries) {
  std::mt19937 generator(8);
  gslam::detail::BowStore store;
  for (std::uint32_t i = 0; i < 50000; ++i) store.add(smallEntry(i));
  EXPECT_EQ(store.view()->size(), 7u);
  std::vector<std::uint64_t> ids(50000);
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = i;
  std::shuffle(ids.begin(), ids.end(), generator);
  while (ids.size() > 1000) {
    ASSERT_TRUE(store.erase(ids.back()));
    ids.pop_back();
    ASSERT_LE(entriesInMemory(store), 2 * ids.size() + 100);
  }
  EXPECT_LE(store.view()->size(), 2u);
  for (const std::uint64_t id : ids) ASSERT_NE(store.find(id), nullptr);
}

TEST(database, has_entries_as_large_as_a_vocabulary) {
  std::mt19937 generator(6);
  BowVector all = bag(generator, 1, 1);
  for (std::uint32_t i = 1; i < 300000; ++i) {
    all.words.push_back(3 * i);
    all.values.push_back(i % 10);
  }
  BowDatabase database(Scoring::l1);
  Bags bags;
  for (int i = 0; i < 4; ++i) {
    const BowVector bow = i % 2 == 0 ? all : bag(generator, 500, 900000, all, 1);
    bags[database.add(normalized(bow, Scoring::l1))] = normalized(bow, Scoring::l1);
  }
  for (const auto& entry : bags) {
    expectSame(database.query(entry.second),
               queryByBruteForce(Scoring::l1, bags, entry.second, QueryOptions()));
  }
}

TEST(database, reuses_the_memory_of_results) {
  std::mt19937 generator(7);
  BowDatabase database(Scoring::l1);
  for (const BowVector& bow : walk(generator, Scoring::l1, 50, 30, 200)) database.add(bow);
  Results results;
  database.query(database.bow(3), QueryOptions(), results);
  ASSERT_EQ(results.size(), 10u);
  EXPECT_EQ(results[0].id, 3u);
  const QueryResult* const memory = results.data();
  database.query(database.bow(4), QueryOptions(), results);
  EXPECT_EQ(results[0].id, 4u);
  EXPECT_EQ(results.data(), memory);
}
