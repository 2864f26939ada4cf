// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>

#include "config/load.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

void add_layer(std::vector<fs::path>& files, const fs::path& folder, const std::string& side) {
  if (folder.empty()) return;
  std::error_code problem;
  const fs::path main_file = folder / (side + ".toml");
  // A file that exists but can't be looked at is kept, so that reading it tells why.
  if (fs::exists(main_file, problem) || problem) files.push_back(main_file);

  const fs::path drop_ins = folder / (side + ".d");
  if (!fs::exists(drop_ins, problem)) return;
  std::vector<fs::path> found;
  fs::directory_iterator entry(drop_ins, problem);
  if (problem) {
    files.push_back(drop_ins);
    return;
  }
  for (; entry != fs::directory_iterator(); entry.increment(problem)) {
    const std::string name = entry->path().filename().string();
    // Hidden files are what editors and package managers leave behind.
    if (entry->path().extension() == ".toml" && !name.starts_with('.')) found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end());
  files.insert(files.end(), found.begin(), found.end());
}

}  // namespace

ConfigSources usual_config_sources() {
  ConfigSources sources;
  sources.system_folder = "/etc/telehug";
  const char* xdg = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  if (xdg != nullptr && *xdg == '/') {
    sources.user_folder = fs::path(xdg) / "telehug";
  } else if (home != nullptr && *home == '/') {
    sources.user_folder = fs::path(home) / ".config/telehug";
  }
  return sources;
}

std::vector<fs::path> config_files(const ConfigSources& sources, Side side) {
  if (sources.only_file) return {*sources.only_file};
  const std::string name = side == Side::active ? "active" : "passive";
  std::vector<fs::path> files;
  add_layer(files, sources.system_folder, name);
  add_layer(files, sources.user_folder, name);
  return files;
}

}  // namespace telehug
