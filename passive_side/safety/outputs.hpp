// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "link/jacket_link.hpp"
#include "safety/consent.hpp"
#include "safety/duty_budget.hpp"
#include "safety/heater_supervision.hpp"
#include "safety/intensity.hpp"
#include "safety/safety_values.hpp"
#include "safety/shares.hpp"

namespace telehug {

// What a jacket's actuators are asked to do, and what of it the limits let through, as commands for the link. Holds no
// link and allocates only while it is made. Times never go back but by forget_time().
class Outputs {
 public:
  enum class Asked { accepted, ended, refused, muted };

  // `counters` outlives it. Throws std::invalid_argument for a profile that is out of range.
  Outputs(const JacketProfile& profile, const SafetyLimits& limits, SafetyCounters& counters);
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  // Of anything but `accepted` the sender asks nothing of this actuator then. sender: below max_senders. What the
  // wearer permits only ever takes away from it.
  Asked ask(SenderNumber sender, const Drive& wanted, const Permission& permission, Timestamp now);

  // What was commanded has run until now. Comes before whatever changes that.
  void pass(Timestamp now);
  // The clock went back to now: nothing is commanded any more.
  void forget_time(Timestamp now);

  // Ends what has come to its end; true if something has.
  bool expire(Timestamp now);
  // All asks forgotten, after which the jacket is to be told. Returns how many actuators ran.
  std::uint64_t forget();
  void forget_heaters();
  // Likewise of one sender; true if it asked for anything. `counter`: of the actuators that are off by that.
  bool forget(SenderNumber sender, std::uint64_t& counter);
  // The jacket has been told, and nothing of it runs by itself any more.
  void silent(Timestamp now);

  // The whole state of what runs or may still run there, within all limits. Counts as commanded from now on.
  MotorCommands motor_commands(const Vouched& vouched, Timestamp now);
  HeaterCommands heater_commands(const Vouched& vouched, const std::optional<JacketTelemetry>& telemetry,
                                 Timestamp now);
  // Has anything of that to be said (again)? `sent`: when it was said last.
  [[nodiscard]] bool renewal_due(const Vouched& vouched, const std::optional<JacketTelemetry>& telemetry,
                                 Timestamp sent, Timestamp now) const;

  // Does anybody ask for anything?
  [[nodiscard]] bool asked() const noexcept;
  [[nodiscard]] bool runs(std::uint8_t id) const noexcept;
  // Ids, in the profile's order.
  [[nodiscard]] Refused running() const;
  // How much of their duty's budget the motors have used up.
  [[nodiscard]] DutyReports duties(Timestamp now);
  [[nodiscard]] HeaterReports heaters(const std::optional<JacketTelemetry>& telemetry, Timestamp now) const;

 private:
  struct Output {
    explicit Output(const Actuator& actuator)
        : id(actuator.id), channel(actuator.channel), place(actuator.place), enabled(actuator.enabled) {}
    std::uint8_t id;
    std::uint8_t channel;
    BodyPoint place;
    bool enabled;
    Shares shares{};
    double given = 0;         // the last command's level
    Timestamp given_until{};  // and its end
    Timestamp silent_from{};  // when the microcontroller has it off even if it hears nothing more

    void give(double level, Timestamp until);
  };
  struct Motor : Output {
    Motor(const Actuator& actuator, const JacketProfile& profile, double most);
    IntensityScale scale;
    DutyBudget duty;
    double max_power;
    double full_ma;
  };
  struct Heater : Output {
    Heater(const Actuator& actuator, const SafetyLimits& limits);
    double most_celsius;
    HeaterSupervision supervision;
  };
  struct Found {
    Output* output = nullptr;
    double level = 0;
  };

  [[nodiscard]] Found find(std::uint8_t id, double strength);

  SafetyCounters& counters_;
  double supply_ma_;
  Duration longest_drive_;
  std::vector<Motor> motors_;
  std::vector<Heater> heaters_;
  std::vector<Output*> all_;  // in the profile's order
  Timestamp passed_;
};

}  // namespace telehug
