// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/accuracy_peers.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace batten::test {
namespace {

namespace fs = std::filesystem;

bool runs(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

std::string outputOf(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) text.append(buffer.data(), n);
  pclose(pipe);
  return text;
}

std::string quoted(const fs::path& path) {
  std::string text("'");
  text.append(path.string()).append("'");
  return text;
}

/// Runs a command that writes an SVG of px times `scale`, and samples its paths. Scaling up puts the first samples of
/// both pictures on one another and not their borders: half a fine pixel and half a coarse one apart.
std::optional<TraceResult> tracedBy(const std::string& command, const fs::path& svg, double scale) {
  fs::remove(svg);
  const auto begin = std::chrono::steady_clock::now();
  const bool done = runs(command);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  std::ifstream in(svg);
  if (!done || !in) return std::nullopt;
  std::vector<SvgPath> paths = readSvgPaths({std::istreambuf_iterator<char>(in), {}});
  for (SvgPath& path : paths)
    for (SvgCubic& cubic : path.segments)
      for (Vec2& p : cubic.p) p = ((p / scale).array() + 0.5 * (1.0 - 1.0 / scale)).matrix();
  TraceResult result = sampledPaths(paths);
  result.milliseconds = ms;
  return result;
}

// -u: its coordinates to a hundredth of a pixel; its SVG is in points at 72 dpi, one a pixel.
constexpr const char* kPotrace = "potrace -b svg -u 100 -r 96 ";

Peer potraceBy(const std::string& options) {
  return {"potrace", runs("potrace --version") ? "" : "not installed",
          [options](const fs::path& pgm, const fs::path& folder) {
            const fs::path svg = folder / "potrace.svg";
            return tracedBy(kPotrace + options + " -o " + quoted(svg) + " " + quoted(pgm), svg, 1.0);
          }};
}

Peer mkbitmap() {
  const bool there = runs("potrace --version") && runs("mkbitmap --version");
  return {"mkbitmap+potrace", there ? "" : "not installed", [](const fs::path& pgm, const fs::path& folder) {
            const fs::path pbm = folder / "mkbitmap.pbm", svg = folder / "mkbitmap.svg";
            return tracedBy("mkbitmap -x -s 2 -o " + quoted(pbm) + " " + quoted(pgm) + " && " + kPotrace + "-o " +
                                quoted(svg) + " " + quoted(pbm),
                            svg, 2.0);
          }};
}

Peer inkscape() {
  std::string missing;
  if (!runs("inkscape --version")) {
    missing = "not installed";
  } else if (outputOf("inkscape --action-list").find("object-trace") == std::string::npos) {
    missing = "this version traces from its window only (it uses potrace inside)";
  }
  return {"inkscape", missing, [](const fs::path& pgm, const fs::path& folder) {
            const fs::path svg = folder / "inkscape.svg";
            // Two levels: ink and paper; no smoothing, speckles 2, corners 1, optimise .2 as its dialogue has them.
            return tracedBy("inkscape " + quoted(pgm) +
                                " --actions='select-all;object-trace:2,false,false,true,2,1.0,0.2;" +
                                "export-plain-svg;export-filename:" + svg.string() + ";export-do'",
                            svg, 1.0);
          }};
}

}  // namespace

std::vector<Peer> peers() { return {potraceBy(""), mkbitmap(), inkscape()}; }

Peer potraceWith(double optimumTolerance) { return potraceBy("-O " + std::to_string(optimumTolerance)); }

bool writePgm(const GreyImage& grey, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << grey.width << ' ' << grey.height << "\n255\n";
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x) out.put(static_cast<char>(grey.row(y)[x] / 257));
  return static_cast<bool>(out);
}

}  // namespace batten::test
