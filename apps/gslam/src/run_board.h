#ifndef GSLAM_APPS_RUN_BOARD_H
#define GSLAM_APPS_RUN_BOARD_H

#include <atomic>
#include <cstdint>

namespace app {

/// Where the process of a run is, in the order in which that comes.
enum class RunPhase : int {
  loading,      ///< the dataset
  making,       ///< the SLAM system: its plugin, its constructor
  preparing,    ///< the files of the results, and what measures
  ready,        ///< waits until it is watched
  configuring,  ///< in configure()
  waiting,      ///< between two calls, such as while a frame is read
  feeding,      ///< in feed()
  finishing,    ///< in finish()
  mapping,      ///< in map()
  played,       ///< waits until what it used was read
  writing,      ///< the results
  ended         ///< all is written
};

/// What the process of a run tells the one that watches it. It lies in memory that both have, so
/// that the last word stays when the process crashes.
struct RunBoard {
  std::atomic<RunPhase> phase{RunPhase::loading};
  std::atomic<std::int64_t> since{0};    ///< when it was entered; nanoseconds of steady_clock
  std::atomic<bool> has_files{false};    ///< whether run.json is of this run
  std::atomic<bool> has_said{false};     ///< why it cannot go on, on stderr
  std::atomic<bool> has_frame{false};    ///< whether a frame was fed
  std::atomic<std::uint64_t> frame{0};   ///< id of the last one
  std::atomic<std::int64_t> process{0};  ///< that runs the SLAM system
  std::atomic<std::uint64_t> invalid_poses{0};  ///< as LiveTrajectory counts them
  std::atomic<std::uint64_t> wrong_stamps{0};   ///< likewise
  std::atomic<bool> is_watched{false};          ///< the answer to `ready`
  std::atomic<bool> is_read{false};             ///< the answer to `played`

  void enter(RunPhase next) noexcept;
};

/// The memory of a RunBoard.
class SharedBoard {
 public:
  /// Makes it. @throws Error
  SharedBoard();
  /// That of another process. @throws Error when the file is none
  explicit SharedBoard(int file);
  SharedBoard(const SharedBoard&) = delete;
  SharedBoard& operator=(const SharedBoard&) = delete;
  ~SharedBoard();

  RunBoard& operator*() const noexcept { return *board_; }
  RunBoard* operator->() const noexcept { return board_; }
  int file() const noexcept { return file_; }  ///< is closed by exec()

 private:
  int file_;
  RunBoard* board_ = nullptr;
};

}  // namespace app

#endif  // GSLAM_APPS_RUN_BOARD_H
