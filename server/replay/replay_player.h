// Plays a recording as those who control it want: one tick for each tick of the server's time. The numbers of
// ticks go on without a gap whatever the moment of the recording does, so that no viewer is reset or cut off.
//
// request() may be called from any thread; all else from one.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/replay/replay_source.h"

namespace scree {

namespace limits {
/// Seconds of the server's time without a new tick of a recording that is being written, whose writer commits
/// twice a second. Above: it counts as cut short, until more comes.
inline constexpr double quiet_s_max = 5.0;

/// Wishes that wait for the next tick; above: refused.
inline constexpr size_t replay_wishes_max = 256;
}  // namespace limits

/// What a replay does at its end.
enum class AtEnd : uint8_t { stay, loop, end };

struct PlayerOptions {
  AtEnd at_end = AtEnd::stay;
  float speed = 1.0F;  ///< replay_speed_least to replay_speed_most
  /// Jumps happen in ticks with poses alone, so that who gets a jump also gets which pieces are gone.
  uint32_t ticks_per_transform = 3;
  /// Is told, in words, when ticks that were played, or asked for, are not there any more; may be empty.
  std::function<void(const std::string&)> tell{};
};

class ReplayPlayer {
 public:
  ReplayPlayer(std::unique_ptr<ReplaySource> source, const PlayerOptions& options);

  const RecordingHeader& header() const { return source_->header(); }

  /// What somebody wants, for the next ticks. Refused when too much waits.
  Result<void> request(const ControlReplayRequest& wish);

  /// The next tick, with TickDelta::playback; null at the end, when it ends there.
  Result<std::shared_ptr<const TickDelta>> next();

  PlaybackMessage state() const;

 private:
  Result<void> heed(const ControlReplayRequest& wish);
  /// Whether the recording has grown. A ring may have dropped the moment: then its first tick is gone to.
  Result<void> refresh_source();
  Result<void> leave_dropped(bool was_there);
  void tell_dropped(Tick tick, const char* what, std::optional<Tick>& told);
  /// What goes with the moment: events, and who was there.
  Result<void> add_company(TickDelta& delta);
  Result<Tick> target_of(const ControlReplayRequest& wish);
  Tick within(double tick) const;
  Result<std::shared_ptr<const TickDelta>> move();
  /// The whole ticks of the credit.
  Tick spend_credit();
  bool at_border() const;
  /// At the end of a recording that is being written: more will come, and its first tick whenever it does.
  bool waits_for_more() const {
    const bool awaits_first = source_->last_tick() == 0 && !source_->is_ended();
    return (grows_ || awaits_first) && speed_ > 0.0F;
  }
  bool may_jump() const { return (number_ + 1) % options_.ticks_per_transform == 0; }

  std::unique_ptr<ReplaySource> source_;
  PlayerOptions options_;
  const Tick from_;         ///< where a loop begins again
  const Tick first_known_;  ///< where the recording began when it was opened
  float speed_;
  bool playing_ = true;
  bool begun_ = false;
  std::optional<Tick> target_;                             ///< of a jump that waits
  double credit_ = 0.0;                                    ///< ticks of the recording that are due
  Tick number_ = 0;                                        ///< of the last tick that was given out
  bool grows_;                                             ///< the recording is being written
  Tick quiet_ticks_ = 0;                                   ///< since it grew last
  std::optional<Tick> told_shown_, told_asked_;            ///< where it began when a dropped tick was told of
  std::shared_ptr<const RecordedCursorsMessage> cursors_;  ///< as given out last
  uint64_t heeded_ = 0;                                    ///< wishes, their moves done
  uint64_t moves_waiting_ = 0;                             ///< wishes whose jump waits
  std::mutex mutex_;
  std::vector<ControlReplayRequest> wishes_;  ///< guarded by mutex_
};

}  // namespace scree
