// What is in a recording, to compare.
#ifndef GSLAM_DATASETS_ROS_TESTS_CONTENT_H
#define GSLAM_DATASETS_ROS_TESTS_CONTENT_H

#include <gslam/datasets_ros/recording.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "recorded.h"

/// Topic, stamp and bytes of all messages, topic by topic.
inline std::vector<Recorded> contentOf(const gslam::Recording& recording) {
  std::vector<Recorded> all;
  for (const gslam::MessageRef& ref : recording.messages()) {
    const gslam::RecordedTopic& topic = recording.topics()[ref.topic];
    all.push_back({topic.name, topic.type, ref.stamp, recording.read(ref)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Recorded& a, const Recorded& b) { return a.topic < b.topic; });
  return all;
}

inline void expectSame(const std::vector<Recorded>& a, const std::vector<Recorded>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].topic, b[i].topic) << i;
    ASSERT_EQ(a[i].type, b[i].type) << i;
    ASSERT_EQ(a[i].received, b[i].received) << i;
    ASSERT_EQ(a[i].bytes, b[i].bytes) << i;
  }
}

#endif  // GSLAM_DATASETS_ROS_TESTS_CONTENT_H
