// SPDX-License-Identifier: Apache-2.0
//
// A calibration file that somebody edited by hand, or that a bad disk changed. What is read can be kept and read again.
#include <cmath>
#include <cstdlib>
#include <string>

#include "calibration/calibration_file.hpp"
#include "doubles/temporary_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace telehug;
  static const TemporaryFolder folder;
  const auto file = folder.write("rig.toml", std::string(data, data + size));
  const auto calibration = read_calibration(file);
  if (!calibration) {
    if (calibration.error().message.empty()) std::abort();
    return 0;
  }
  if (!write_calibration(folder / "again.toml", *calibration)) std::abort();
  const auto again = read_calibration(folder / "again.toml");
  if (!again || again->model_name() != calibration->model_name()) std::abort();
  return 0;
}
