// Checksums: values that the reference implementation of XXH64 gives.
#include <gslam/vocabulary/detail/checksum.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

std::uint64_t checksumOf(const std::string& text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  return gslam::detail::checksum64(bytes.data(), bytes.size());
}

}  // namespace

TEST(checksum, has_the_published_values) {
  EXPECT_EQ(checksumOf(""), 0xEF46DB3751D8E999u);
  EXPECT_EQ(checksumOf("a"), 0xD24EC4F1A98C6E5Bu);
  EXPECT_EQ(checksumOf("abc"), 0x44BC2CF5AD770999u);
  EXPECT_EQ(checksumOf("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1u);
}

TEST(checksum, is_another_for_every_length_and_flipped_bit) {
  std::vector<std::uint8_t> bytes(100, 0);
  std::vector<std::uint64_t> seen;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    seen.push_back(gslam::detail::checksum64(bytes.data(), size));
  }
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] = static_cast<std::uint8_t>(1u << (bit % 8));
    seen.push_back(gslam::detail::checksum64(bytes.data(), bytes.size()));
    bytes[bit / 8] = 0;
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(seen[i], seen[j]);
  }
}

TEST(little_endian, is_the_same_on_every_machine) {
  const std::uint8_t bytes[] = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(gslam::detail::readLittleEndian<std::uint64_t>(bytes), 0x0807060504030201u);
  std::uint8_t written[8] = {};
  gslam::detail::writeLittleEndian(written, 1.0);  // IEEE 754: 0x3FF0 0000 0000 0000
  EXPECT_EQ(written[6], 0xF0);
  EXPECT_EQ(written[7], 0x3F);
  EXPECT_EQ(gslam::detail::readLittleEndian<double>(written), 1.0);
}
