// SPDX-License-Identifier: Apache-2.0
//
// What of a status (common/ctl/README.md) is a number now, for the table of metrics alone: each writes the samples of
// the family that was begun, and none if the status has nothing of it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "service/open_metrics.hpp"

namespace telehug::status_numbers {

void tell_build(const nlohmann::json& status, OpenMetricsText& text);
void tell_uptime(const nlohmann::json& status, OpenMetricsText& text);
void tell_state(const nlohmann::json& status, OpenMetricsText& text);
void tell_problems(const nlohmann::json& status, OpenMetricsText& text);
void tell_peers(const nlohmann::json& status, OpenMetricsText& text);
void tell_round_trip(const nlohmann::json& status, OpenMetricsText& text);
void tell_one_way(const nlohmann::json& status, OpenMetricsText& text);
void tell_camera_open(const nlohmann::json& status, OpenMetricsText& text);
void tell_camera_problems(const nlohmann::json& status, OpenMetricsText& text);
void tell_face(const nlohmann::json& status, OpenMetricsText& text);
void tell_jacket_state(const nlohmann::json& status, OpenMetricsText& text);
void tell_supply(const nlohmann::json& status, OpenMetricsText& text);
void tell_running(const nlohmann::json& status, OpenMetricsText& text);
void tell_duty(const nlohmann::json& status, OpenMetricsText& text);
void tell_heaters(const nlohmann::json& status, OpenMetricsText& text);
void tell_set_points(const nlohmann::json& status, OpenMetricsText& text);

}  // namespace telehug::status_numbers
