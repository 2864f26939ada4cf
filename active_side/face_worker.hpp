// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "body_map/body_map.hpp"
#include "body_map/body_map_step.hpp"
#include "common/latest_slot.hpp"
#include "sending_switch.hpp"
#include "service/metrics.hpp"

namespace telehug {

struct FaceState {
  std::string screen;   // what is looked at
  bool open = false;    // is it being looked at now?
  std::string problem;  // why there is no face; empty if there is one
  std::string finder;
  BodyMap map;
  std::optional<ScreenScale> scale;  // of the monitor's pixels, if it is looked at
  std::string remark;                // what the user should know of the screen although all works; may be empty
  int others = 0;                    // faces that could be followed instead
  bool pinned = false;
};

// How long from one look to the next: `period`; but half a second at least where no face was seen for 10 s and more.
[[nodiscard]] Duration look_interval(Duration period, Duration without_face);

// What a person says about whom to follow.
enum class FaceOrder { next, pin, unpin };

// Looks for the remote face at its own pace, in a thread of its own, so that no touch ever waits for it.
class FaceWorker {
 public:
  // Takes what it works with; `metrics` and `clock` outlive it.
  FaceWorker(std::unique_ptr<ScreenGrabber> grabber, std::unique_ptr<FaceFinder> finder,
             const BodyMapStepConfig& config, double rate_hz, const Clock& clock, MetricsRegistry& metrics);
  ~FaceWorker();
  FaceWorker(const FaceWorker&) = delete;
  FaceWorker& operator=(const FaceWorker&) = delete;

  // The screen is looked at only while somebody wants it; otherwise it is closed and the map is gone. One thread says
  // so, as often as it likes: only a change of mind costs something.
  void want(bool wanted);

  // Was the screen looked at since it was last wanted, so that it is known whether there is a face?
  [[nodiscard]] bool has_looked() const noexcept { return has_looked_; }

  // For the touch path: the newest map in `map` if there is a newer one. Never waits.
  void update(BodyMap& map);

  // As of the last look.
  [[nodiscard]] ScreenView view() const noexcept;

  // Where telehug itself draws on the monitor, px: not looked at from the next look on. From any thread.
  void leave_out(const std::vector<cv::Rect>& areas_px);

  // Done before the next look, which comes at once. From any thread.
  void order(FaceOrder order);

  [[nodiscard]] FaceState state() const;

 private:
  enum class Front { unknown, front, covered };

  void work();
  void do_round(bool wanted, const std::vector<FaceOrder>& orders);
  void fail(const std::exception& fault);
  void obey(const std::vector<FaceOrder>& orders);
  void look();
  void rest();

  std::unique_ptr<ScreenGrabber> grabber_;
  std::unique_ptr<FaceFinder> finder_;
  BodyMapStep step_;
  const bool live_;
  const bool pins_window_;
  Duration period_;
  const Clock& clock_;
  LatencyHistogram& latency_;
  LatestSlot<BodyMap> newest_;
  Timestamp last_face_;
  std::atomic<bool> has_looked_ = false;
  std::atomic<Front> front_ = Front::unknown;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> wanted_ = false;  // written under the mutex
  bool ending_ = false;
  std::vector<FaceOrder> orders_;
  std::optional<std::vector<cv::Rect>> left_out_px_;  // that the grabber does not know yet
  FaceState state_;
  std::thread thread_;
};

}  // namespace telehug
