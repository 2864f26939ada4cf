// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/latest_slot.hpp"
#include "daemon/membership.hpp"
#include "daemon/pairs_watch.hpp"

namespace telehug {

// A daemon's connections, one for each of its pairs: those of pairs that end are closed, those of new ones opened,
// while the pipeline goes on. C has membership() and name(), and a Connection within.
template <typename C>
class Connections {
 public:
  using List = std::vector<std::shared_ptr<C>>;
  // `others`: those that exist beside the new one.
  // May throw.
  using Make = std::function<std::shared_ptr<C>(Membership, const List& others)>;

  Connections(PairsWatch watch, Make make) : watch_(std::move(watch)), make_(std::move(make)) {}

  // --- housekeeping thread ---

  // Throws as `make` does.
  void open(std::vector<Membership> memberships) {
    List list;
    for (Membership& membership : memberships)
      list.push_back(make_(std::move(membership), list));
    set(std::move(list));
  }

  // Every round. Of every connection whose pair has ended: `ending` is called with it, and why, while the pipeline
  // still uses it, `ended` after the pipeline was told to let go of it. False if none is left.
  bool follow_pairs(WallTime now, const std::function<void(C&, const std::string&)>& ending,
                    const std::function<void(C&)>& ended) {
    List list = all();
    List over;
    for (const auto& connection : list) {
      const auto why = pair_over(connection->membership(), now);
      if (!why) continue;
      ending(*connection, *why);
      over.push_back(connection);
    }
    for (const auto& connection : over)
      std::erase(list, connection);
    bool changed = !over.empty();
    if (!list.empty()) changed = add_new_pairs(list, now) || changed;
    const bool any_left = !list.empty();
    if (changed) set(std::move(list));
    for (const auto& connection : over)
      ended(*connection);
    over.clear();
    // The pipeline lets go of a connection when it looks at the list; only then may it be destroyed, and not there.
    std::erase_if(leaving_, [](const auto& connection) { return connection.use_count() == 1; });
    return any_left;
  }

  // The pipeline has ended: nobody else holds them any more.
  void close() {
    set({});
    (void)for_pipeline_.take();
    adopted_.clear();
    leaving_.clear();
  }

  // --- pipeline's thread ---

  // True if the list is another than before.
  bool adopt() {
    auto list = for_pipeline_.try_take();
    if (!list) return false;
    adopted_ = *std::move(list);
    return true;
  }
  [[nodiscard]] const List& adopted() const noexcept { return adopted_; }

  // --- any thread ---

  [[nodiscard]] List all() const {
    const std::lock_guard lock(mutex_);
    return list_;
  }

 private:
  bool add_new_pairs(List& list, WallTime now) {
    auto memberships = watch_.changed(now);
    if (!memberships) return false;
    bool changed = false;
    List others = all();
    others.insert(others.end(), leaving_.begin(), leaving_.end());
    for (Membership& membership : *memberships) {
      const auto same = [&](const auto& other) { return same_pair(other->membership(), membership); };
      if (!membership.pair || std::any_of(list.begin(), list.end(), same)) continue;
      try {
        list.push_back(make_(std::move(membership), others));
      } catch (const std::exception& problem) {
        watch_.look_again(problem.what());
        continue;
      }
      others.push_back(list.back());
      changed = true;
    }
    // The first pair ends what an unpaired daemon does: loopback for everybody on this PC.
    if (changed) std::erase_if(list, [](const auto& connection) { return !connection->membership().pair; });
    return changed;
  }

  void set(List list) {
    const std::lock_guard lock(mutex_);
    for (const auto& old : list_)
      if (std::find(list.begin(), list.end(), old) == list.end()) leaving_.push_back(old);
    list_ = list;
    for_pipeline_.put(std::move(list));
  }

  PairsWatch watch_;
  Make make_;
  List leaving_;
  List adopted_;  // the pipeline's
  LatestSlot<List> for_pipeline_;
  mutable std::mutex mutex_;
  List list_;  // guarded by mutex_
};

}  // namespace telehug
