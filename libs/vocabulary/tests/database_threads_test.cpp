// Queries while others add and erase: run under ThreadSanitizer, too.
#include <gslam/vocabulary/database.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "random_bags.h"

namespace {

using gslam::BowDatabase;
using gslam::BowVector;
using gslam::QueryOptions;
using gslam::QueryResult;
using gslam::Scoring;

// Every entry is one of these, so that a thread knows what its score must be.
std::vector<BowVector> someBags() {
  std::mt19937 generator(1);
  std::vector<BowVector> bags;
  for (int i = 0; i < 7; ++i) {
    BowVector bow = random_bags::bag(generator, 40, 400);
    normalize(bow, Scoring::l1);
    bags.push_back(bow);
  }
  return bags;
}

// Words that no other entry has, so that tables become too small.
BowVector strangeBag(BowVector bow, std::uint64_t id) {
  for (std::uint32_t& word : bow.words) word += static_cast<std::uint32_t>(1000 + 400 * id);
  return bow;
}

// Whether each result is a whole entry, once, better ones first.
bool areSound(const std::vector<QueryResult>& results, const std::vector<double>& scores) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (std::fabs(results[i].score - scores[results[i].id % scores.size()]) > 1e-14) return false;
    if (i == 0) continue;
    if (results[i].score > results[i - 1].score) return false;
    if (results[i].score == results[i - 1].score && results[i].id <= results[i - 1].id) {
      return false;
    }
  }
  return true;
}

// Asks until it is told to stop; whether all answers were right.
bool askUntil(const std::atomic<bool>& is_over, const BowDatabase& database,
              const std::vector<BowVector>& bags, std::uint64_t kept) {
  std::vector<double> scores;
  for (const BowVector& bow : bags) scores.push_back(score(Scoring::l1, bags[0], bow));
  std::vector<QueryResult> results;
  QueryOptions options;
  bool is_right = true;
  for (std::uint64_t turn = 0; !is_over.load(); ++turn) {
    options.count = turn % 3 == 0 ? 0 : 20;
    database.query(bags[0], options, results);
    is_right = is_right && areSound(results, scores) && !results.empty();
    // The first entries are never erased, and those of bag 0 are the best.
    for (std::size_t i = 0; 7 * i < kept && i < results.size(); ++i) {
      is_right = is_right && results[i].id == 7 * i;
    }
    is_right = is_right && database.bow(turn % kept) == bags[turn % kept % bags.size()];
    is_right = is_right && database.size() >= kept;
  }
  return is_right;
}

}  // namespace

TEST(database_threads, see_each_entry_wholly_or_not_at_all) {
  constexpr std::uint64_t kKept = 40;
  const std::vector<BowVector> bags = someBags();
  BowDatabase database(Scoring::l1);
  for (std::uint64_t i = 0; i < kKept; ++i) database.add(bags[i % bags.size()]);

  std::atomic<bool> is_over{false};
  std::atomic<int> right_count{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      if (askUntil(is_over, database, bags, kKept)) ++right_count;
    });
  }
  // What is alive goes up and down, so that segments are made anew under the eyes of the readers.
  std::uint64_t oldest = kKept;
  for (std::uint64_t i = kKept; i < 12000; ++i) {
    const BowVector& bow = bags[i % bags.size()];
    EXPECT_EQ(database.add(i % 7 == 6 ? strangeBag(bow, i) : bow), i);
    const std::uint64_t window = i / 2000 % 2 == 0 ? 1000 : 100;
    for (int k = 0; k < 3 && oldest + window < i; ++k) EXPECT_TRUE(database.erase(oldest++));
  }
  is_over = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(right_count, 3);
  EXPECT_EQ(database.size(), 12000 - (oldest - kKept));
}

TEST(database_threads, may_add_at_once_and_get_ids_of_their_own) {
  const std::vector<BowVector> bags = someBags();
  BowDatabase database(Scoring::l1);
  std::vector<std::vector<std::uint64_t>> ids(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 500; ++k) {
        ids[i].push_back(database.add(bags[i]));
        if (k % 3 == 2) database.erase(ids[i][static_cast<std::size_t>(k) - 1]);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::vector<bool> is_taken(2000, false);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (std::size_t k = 0; k < ids[i].size(); ++k) {
      const std::uint64_t id = ids[i][k];
      ASSERT_LT(id, 2000u);
      EXPECT_FALSE(is_taken[id]);
      is_taken[id] = true;
      const bool was_erased = k % 3 == 1 && k + 1 < ids[i].size();
      ASSERT_EQ(database.contains(id), !was_erased);
      if (!was_erased) {
        EXPECT_EQ(database.bow(id), bags[i]);
      }
    }
  }
}

TEST(database_threads, may_clear_and_save_meanwhile) {
  const std::vector<BowVector> bags = someBags();
  BowDatabase database(Scoring::kl);
  std::atomic<bool> is_over{false};
  std::vector<std::thread> others;
  others.emplace_back([&] {
    while (!is_over.load()) {
      for (const BowVector& bow : bags) database.add(bow);
      if (database.nextId() % 5 == 0) database.clear();
    }
  });
  others.emplace_back([&] {
    while (!is_over.load()) database.query(bags[1]);
  });
  const std::string path =
      testing::TempDir() + std::to_string(getpid()) + "_gslam_database_threads_test.bow";
  std::size_t not_empty = 0;
  for (int i = 0; i < 20 || not_empty < 5; ++i) {  // else CTest ends it
    database.save(path);
    const BowDatabase loaded = gslam::loadDatabase(path);
    not_empty += loaded.empty() ? 0 : 1;
    for (const std::uint64_t id : loaded.ids()) {
      EXPECT_EQ(loaded.bow(id), bags[id % bags.size()]);
    }
  }
  is_over = true;
  for (std::thread& other : others) other.join();
  std::remove(path.c_str());
}
