// SPDX-License-Identifier: GPL-3.0-or-later
// Stability maps: bench_stability prints the tables of doc/schemes.md.
#include "bench/stability_map.hpp"
#include <cmath>
#include <cstdio>

namespace {

using namespace fretwork;
using transient::SchemeKind;

constexpr double resolutions[] = {0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 1.95, 2.5, 4.0};

template <class Point>
void print(const char* title, const char* what, const std::vector<double>& levels, Point point) {
  std::printf("\n%s\n\n| scheme | %s |", title, what);
  for (const double r : resolutions)
    std::printf(" %g |", r);
  std::printf("\n| --- | --- |");
  for (std::size_t i = 0; i < std::size(resolutions); ++i)
    std::printf(" --- |");
  std::printf("\n");
  for (const SchemeKind scheme : {SchemeKind::splitting, SchemeKind::collocation,
                                  SchemeKind::energy_conserving, SchemeKind::euler, SchemeKind::devogelaere})
    for (const double level : levels) {
      std::printf("| %s | %g |", transient::name_of(scheme).c_str(), level);
      for (const double r : resolutions) {
        const bench::MapPoint p = point(scheme, r, level);
        if (std::isfinite(p.error))
          std::printf(" %.1f%s |", 100.0 * p.error, p.warned ? " !" : "");
        else
          std::printf(" x%s |", p.warned ? " !" : "");
      }
      std::printf("\n");
      std::fflush(stdout);
    }
}

} // namespace

int main() {
  std::printf("Steps of w_c h (w_t h) = 0.1 to 4; ! = the run warns; x = it diverges.\n");
  print("Bouncing between stops: energy gained, % an impact", "high mode / w_c", {0.0, 3.0, 20.0},
        bench::bouncing);
  print("Rubbing: error of the friction power, %", "r_t / w_t", {0.2, 2.0, 10.0}, bench::rubbing);
}
