#include <gslam/base/detail/checksum.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace {

// What the reference implementation gives.
TEST(Checksum, IsXxh64) {
  const auto hash = [](const std::string& text) {
    return gslam::detail::Xxh64::of(reinterpret_cast<const std::uint8_t*>(text.data()),
                                    text.size());
  };
  EXPECT_EQ(hash(""), 0xEF46DB3751D8E999u);
  EXPECT_EQ(hash("a"), 0xD24EC4F1A98C6E5Bu);
  EXPECT_EQ(hash("abc"), 0x44BC2CF5AD770999u);
  EXPECT_EQ(hash("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1u);
}

}  // namespace
