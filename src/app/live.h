#pragma once
// A program that runs in an emulator, as the window shows it: its frames as they come, the last of them kept
// to go back to, and a way to ask things of the program. The other end is door/window_process.h.

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/subject.h"
#include "app/tape.h"
#include "debug/clip.h"
#include "door/live.h"

namespace app {

/// A frame of a running program as a clip: with buckets, addresses and lint of the lists it was sent as.
debug::Clip clip_of(const door::LiveFrame& frame);

/// The socket: frames come in on a thread of its own, of which the newest waits to be taken.
class LiveLink {
 public:
  /// `socket` is the link's from now on. `wake`: called on that thread when there is something to take.
  LiveLink(int socket, std::function<void()> wake);
  ~LiveLink();
  LiveLink(const LiveLink&) = delete;
  LiveLink& operator=(const LiveLink&) = delete;

  /// Frames that came since the last call; too many of them, and the oldest are left out.
  std::vector<door::LiveFrame> take();
  void ask(door::LiveAsk what, std::uint32_t value = 0);
  /// The program has ended, or what came was no frame: then error() says so.
  [[nodiscard]] bool has_ended();
  [[nodiscard]] std::string error();

 private:
  void read_frames();

  int socket_;
  std::function<void()> wake_;
  std::mutex mutex_;
  std::deque<door::LiveFrame> inbox_;
  bool has_ended_ = false;
  std::string error_;
  std::thread reader_;
};

/// The last frames of a program.
class LiveReel {
 public:
  static constexpr std::size_t kept_frames = 60;  ///< a state of 1 MiB each
  struct Kept {
    std::int64_t number = 0;
    debug::Clip clip;
    std::uint64_t doubtful = 0;
    bool is_recording = false;
  };
  void add(const door::LiveFrame& frame);
  [[nodiscard]] bool is_empty() const { return kept_.empty(); }
  [[nodiscard]] std::int64_t first() const { return kept_.empty() ? 1 : kept_.front().number; }
  [[nodiscard]] std::int64_t last() const { return kept_.empty() ? 1 : kept_.back().number; }
  /// The frame, or the one before it if it was let pass. Needs one.
  [[nodiscard]] const Kept& at(std::int64_t frame) const;
  /// The frame kept after it, or before; the last and the first stay.
  [[nodiscard]] std::int64_t after(std::int64_t frame) const;
  [[nodiscard]] std::int64_t before(std::int64_t frame) const;

 private:
  std::deque<Kept> kept_;
};

class Live final : public ClipDrawer {
 public:
  /// `link` may be null: then frames come by reel() alone.
  explicit Live(std::shared_ptr<LiveLink> link, std::shared_ptr<LiveReel> reel = std::make_shared<LiveReel>())
      : ClipDrawer(Shown::either), link_(std::move(link)), reel_(std::move(reel)) {
    why_empty_ = "no frame has come yet";
  }

  [[nodiscard]] Live* live() override { return this; }
  /// Takes what has come. True: there are new frames.
  bool take_frames();
  [[nodiscard]] LiveLink* link() const { return link_.get(); }
  [[nodiscard]] LiveReel& reel() { return *reel_; }
  [[nodiscard]] bool is_recording_program() const {
    return !reel_->is_empty() && reel_->at(reel_->last()).is_recording;
  }

  /// Knobs that a stream of words can honour are; a canvas lies over the picture of the frame.
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                       const CameraOffset& camera) override;
  base::Result<debug::Clip> clip(std::int64_t frame, const scene::Knobs& knobs,
                                 const CameraOffset& camera) override;
  [[nodiscard]] std::unique_ptr<Subject> another(const scene::Knobs& knobs) const override;
  [[nodiscard]] std::unique_ptr<Subject> apart(std::int64_t frame, const scene::Knobs& knobs) override;
  [[nodiscard]] std::optional<std::int64_t> last_frame() const override { return reel_->last(); }

 private:
  std::shared_ptr<LiveLink> link_;
  std::shared_ptr<LiveReel> reel_;
};

}  // namespace app
