// Whole messages through the socket between the two processes.
#ifndef GSLAM_CORE_DETAIL_ISOLATION_CHANNEL_H
#define GSLAM_CORE_DETAIL_ISOLATION_CHANNEL_H

#include <gslam/core/detail/child_process.h>
#include <gslam/core/detail/isolation_messages.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

#if GSLAM_DETAIL_HAS_ISOLATION

// What came of receiving a message; `broken` is one that nobody of ours wrote.
enum class Received { done, closed, late, broken };

struct Message {
  MessageKind kind = MessageKind::quit;
  std::vector<char> bytes;
};

inline Transfer sendMessage(int socket, MessageKind kind, const std::vector<char>& bytes,
                            const ChildProcess* child, Deadline deadline) {
  const MessageHead head = {kMessageMagic, kind, bytes.size()};
  const Transfer sent = sendBytes(socket, &head, sizeof(head), child, deadline);
  if (sent != Transfer::done) return sent;
  return sendBytes(socket, bytes.data(), bytes.size(), child, deadline);
}

inline Received receivedAs(Transfer transfer) noexcept {
  if (transfer == Transfer::done) return Received::done;
  return transfer == Transfer::late ? Received::late : Received::closed;
}

// Memory is taken as bytes come, so that a wrong size costs nothing.
inline Received receiveMessage(int socket, Message& message, const ChildProcess* child,
                               Deadline deadline) {
  constexpr std::uint64_t kMost = std::uint64_t(1) << 40;
  constexpr std::uint64_t kStep = std::uint64_t(1) << 20;
  MessageHead head = {};
  Transfer got = receiveBytes(socket, &head, sizeof(head), child, deadline);
  if (got != Transfer::done) return receivedAs(got);
  if (head.magic != kMessageMagic || head.size > kMost) return Received::broken;
  message.kind = head.kind;
  message.bytes.clear();
  while (message.bytes.size() < head.size) {
    const std::size_t before = message.bytes.size();
    const std::uint64_t step = std::min<std::uint64_t>(kStep + before, head.size - before);
    message.bytes.resize(before + std::size_t(step));
    got = receiveBytes(socket, message.bytes.data() + before, std::size_t(step), child, deadline);
    if (got != Transfer::done) return receivedAs(got);
    if (std::chrono::steady_clock::now() >= deadline) return Received::late;
  }
  return Received::done;
}

#endif  // GSLAM_DETAIL_HAS_ISOLATION

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_ISOLATION_CHANNEL_H
