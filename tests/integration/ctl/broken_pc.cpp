// SPDX-License-Identifier: Apache-2.0
#include "integration/ctl/broken_pc.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdio>

#include "integration/cli/shell.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::json;

struct Row {
  std::string set_up;
  std::string line;
  std::string fix;
};
std::vector<Row>& table() {
  static std::vector<Row> rows;
  return rows;
}

std::string quoted(const std::string& word) {
  return "'" + word + "'";
}

}  // namespace

BrokenPc::BrokenPc() {
  for (const char* file : {"root/dev/video0", "root/dev/ttyACM0", "root/sys/class/bluetooth/hci0/address"})
    write(file, "");
  write("root/proc/version", "Linux version 6.1.0-50-amd64 (Debian 6.1.176-1)");
  fs::create_directory_symlink("/proc/net", root() / "proc/net");
  write("root/sys/class/drm/card0-DP-1/status", "connected\n");
  std::string edid(128, '\0');
  edid[66] = static_cast<char>(520 & 0xFF);
  edid[67] = static_cast<char>(290 & 0xFF);
  edid[68] = static_cast<char>(((520 >> 8) << 4) | (290 >> 8));
  write("root/sys/class/drm/card0-DP-1/edid", edid);
  write("state/telehug/rig.toml",
        "[image]\nwidth_px = 1280\nheight_px = 720\n[screen]\nwidth_mm = 521\nheight_mm = 291\n");
  configure("active", "[body_map]\npicture = \"chat.jpg\"\n");
  configure("passive", "[jacket]\nlink = \"serial:/dev/ttyACM0\"\n");
  fs::create_directories(runtime());
  for (const char* side : {"active", "passive"}) {
    fs::create_directories(state() / "pairs" / side);
    fs::permissions(state() / "pairs" / side, fs::perms::owner_all);
  }
  const std::string base = folder_.path().string();
  variables_ = {"HOME=" + base,
                "XDG_CONFIG_HOME=" + base + "/config",
                "XDG_STATE_HOME=" + base + "/state",
                "XDG_RUNTIME_DIR=" + runtime().string(),
                "DISPLAY=",
                "WAYLAND_DISPLAY="};
}

Json BrokenPc::ask(const std::string& side, int& code) const {
  std::string command = before + " ";
  if (as_nobody && ::geteuid() == 0) {
    // Root may do everything: then another user asks, whose PC it is.
    (void)shell("chown -R --no-dereference 65534:65534 " + folder_.path().string());
    command += "setpriv --reuid=65534 --regid=65534 --clear-groups ";
  }
  command += "env";
  for (const std::string& variable : variables_)
    command += " " + quoted(variable);
  command += " " TELEHUG_BIN "/telehug doctor " + side + " --json --root " + root().string() + " " + options;
  const ShellRun run = shell(command);
  code = run.code;
  return Json::parse(run.text).at("findings");
}

void BrokenPc::expect(const std::string& side, const Diagnosis& diagnosis) {
  int code = -1;
  const Json all = ask(side, code);
  std::string found;
  bool named = false;
  for (const Json& finding : all) {
    const auto text = [&](const char* key) { return finding.at(key).get<std::string>(); };
    EXPECT_TRUE(text("level") != "fail" || text("check") == diagnosis.check) << finding;
    if (text("check") != diagnosis.check || text("level") != diagnosis.level) continue;
    found += text("what") + "\n-> " + text("fix") + "\n";
    if (text("what").find(diagnosis.what) == std::string::npos || text("fix").find(diagnosis.fix) == std::string::npos)
      continue;
    if (!named && !diagnosis.set_up.empty())
      table().push_back({diagnosis.set_up, text("level") + " " + text("check") + ": " + text("what"), text("fix")});
    named = true;
  }
  EXPECT_TRUE(named) << diagnosis.check << " says\n" << found << "in\n" << all.dump(1);
  EXPECT_EQ(code, to_int(diagnosis.level == "fail" ? ExitCode::fault : ExitCode::ok));
}

void BrokenPc::TearDownTestSuite() {
  for (const Row& row : table())
    std::printf("%-34s %s\n%-34s -> %s\n", row.set_up.c_str(), row.line.c_str(), "", row.fix.c_str());
  table().clear();
}

}  // namespace telehug
