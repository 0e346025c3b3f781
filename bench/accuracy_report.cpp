// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/accuracy_study.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>

namespace fretwork::bench {
namespace {

double quantile(std::vector<double> sorted, double share) {
  return sorted.empty()
             ? 0.0
             : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
}

struct Row {
  std::size_t within = 0, noisy = 0;
  std::vector<double> errors; ///< |relative|
  void add(const FigureError& e) {
    within += e.fails ? 0 : 1;
    noisy += e.standard_error > 0.01 * e.reference ? 1 : 0;
    errors.push_back(std::abs(e.relative()));
  }
  void print(const std::string& kind, const char* figure) {
    std::sort(errors.begin(), errors.end());
    std::printf("| %s | %s | %zu | %.1f | %.2f | %.2f | %.2f | %zu |\n", kind.c_str(), figure, errors.size(),
                100.0 * static_cast<double>(within) / static_cast<double>(errors.size()),
                100.0 * quantile(errors, 0.5), 100.0 * quantile(errors, 0.9), 100.0 * quantile(errors, 1.0),
                noisy);
  }
};

} // namespace

void print_figures(const SceneResult& result, bool all) {
  if (!result.failure.empty())
    std::printf("| %s | %s | | | | |\n", result.scene.name.c_str(), result.failure.c_str());
  for (const FigureError& e : result.figures)
    if (e.fails || (all && e.judged))
      std::printf("| %s | %s | %.4g | %.4g | %+.2f | %.2f | %+.2f +- %.2f | %d |\n",
                  result.scene.name.c_str(), figure_names[e.figure], e.ours, e.reference,
                  100.0 * e.relative(), 100.0 * e.standard_error / e.reference, 100.0 * e.measured,
                  100.0 * e.measured_spread, result.step_error.parts);
}

void print_summary(const std::vector<SceneResult>& results, const StudyOptions& options) {
  std::printf("\nTolerance %.2g %% plus two standard errors. Errors are |difference| in %% of the reference; "
              "noisy: standard error "
              "above 1 %%.\n\n"
              "| scenes | figure | count | within, %% | median | 90 %% | worst | noisy |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n",
              100.0 * options.tolerance());
  Row all;
  for (const SceneKind kind : {SceneKind::mass, SceneKind::tube, SceneKind::pair, SceneKind::mixed})
    for (std::size_t k = 0; k < figure_count; ++k) {
      Row row;
      for (const SceneResult& result : results)
        for (const FigureError& e : result.figures)
          if (result.scene.kind == kind && e.figure == k &&
              (e.judged || (k == normal_max && e.reference > 0.0))) {
            row.add(e);
            if (e.judged)
              all.add(e);
          }
      if (!row.errors.empty())
        row.print(name_of(kind), figure_names[k]);
    }
  if (!all.errors.empty())
    all.print("all", "all but normal_max");
  double seconds = 0.0, reference = 0.0;
  std::size_t failures = 0;
  std::int64_t unresolved = 0;
  for (const SceneResult& result : results) {
    seconds += result.seconds;
    reference += result.reference_seconds;
    unresolved += result.unresolved;
    failures += result.failure.empty() ? 0 : 1;
  }
  std::printf("\n%zu scenes, %zu of them without an end; processor time of the runs %.1f s, of the reference "
              "solution %.1f s\n",
              results.size(), failures, seconds, reference);
  if (unresolved > 0)
    std::printf("The reference solution has not found %lld contact forces and closures\n",
                static_cast<long long>(unresolved));
}

void write_csv(const std::string& file, const std::vector<SceneResult>& results) {
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (!out)
    throw core::Error(fmt::format("{} cannot be written", file));
  fmt::print(out, "scene,kind,figure,ours,reference,difference_percent,standard_error_percent,judged,fails,"
                  "scheme,step_s,w_c_h,"
                  "duration_s,members,closed,sliding,seconds,reference_seconds,description\n");
  for (const SceneResult& r : results) {
    const auto tail = fmt::format("{},{:.6g},{:.4g},{:.6g},{},{:.5g},{:.5g},{:.4g},{:.4g},\"{}\"\n", r.scheme,
                                  r.step, r.resolution, r.duration, r.members, r.closed, r.sliding, r.seconds,
                                  r.reference_seconds, r.scene.description);
    if (!r.failure.empty())
      fmt::print(out, "{},{},{},,,,,1,1,{}", r.scene.name, name_of(r.scene.kind), r.failure, tail);
    for (const FigureError& e : r.figures)
      fmt::print(out, "{},{},{},{:.9g},{:.9g},{:.5g},{:.5g},{:d},{:d},{}", r.scene.name,
                 name_of(r.scene.kind), figure_names[e.figure], e.ours, e.reference, 100.0 * e.relative(),
                 100.0 * e.standard_error / e.reference, e.judged, e.fails, tail);
  }
  std::fclose(out);
}

} // namespace fretwork::bench
