// SPDX-License-Identifier: Apache-2.0
//
// Files beside a calibration and of a recording, as a person or a bad disk may have changed them: the screen's size,
// tables of frames and truth, the camera's settings of before, the picture of the empty rig.
#include <cstdlib>
#include <string>

#include "capture/camera_memory.hpp"
#include "capture/rig_directory.hpp"
#include "doubles/temporary_folder.hpp"
#include "finger/background_file.hpp"
#include "fuzz/bytes.hpp"

namespace telehug {
namespace {

constexpr const char* screen = "width_mm = 380.0\nheight_mm = 300.0\nresolution = [1280, 1024]\n";

class Files {
 public:
  Files() {
    for (const char* picture : {"frames/1.jpg", "sequence/1.jpg", "sequence/2.jpg", "calibration/1.jpg"})
      folder_.write(picture, "");  // only their names are looked at
    folder_.write("rig.toml", screen);
  }

  void read(const std::string& name, const std::string& text) const {
    const auto file = folder_.write(name, text);
    const auto rig = open_rig_directory(folder_.path());
    if (!rig && rig.error().message.empty()) std::abort();
    if (name == "rig.toml") {
      folder_.write(name, screen);
    } else {
      std::filesystem::remove(file);
    }
  }

  // What is read is kept and read again as the same.
  void read_camera(const std::string& text) const {
    const auto memory = read_camera_memory(folder_.write("camera.toml", text));
    if (!memory || !*memory) return;
    const auto file = folder_ / "again.toml";
    if (!write_camera_memory(file, **memory)) std::abort();
    const auto again = read_camera_memory(file);
    if (!again || !*again || (*again)->device != (*memory)->device) std::abort();
    if ((*again)->controls.size() != (*memory)->controls.size()) std::abort();
  }

  void read_background(const std::string& bytes) const {
    static const BorderStrip::Layout layout{BorderCurve(BorderLine{28, 0.01}, {64, 40}), {64, 40}};
    const auto strip = telehug::read_background(folder_.write("rig.background.png", bytes), layout);
    if (strip ? strip->columns() != layout.columns : strip.error().message.empty()) std::abort();
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const telehug::Files files;
  telehug::Bytes bytes(data, size);
  const std::uint8_t which = bytes.byte() % 7;
  static constexpr const char* of_a_recording[]{"rig.toml", "truth.csv", "times.csv", "calibration.csv",
                                                "sequence/times.csv"};
  if (which < 5) files.read(of_a_recording[which], bytes.rest());
  if (which == 5) files.read_camera(bytes.rest());
  if (which == 6) files.read_background(bytes.rest());
  return 0;
}
