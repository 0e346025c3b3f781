// SPDX-License-Identifier: GPL-3.0-or-later
// Processor time of a bundle against its tubes, with contacts between tubes and without them: bench_bundle [TUBES ...] [together].
// `together`: with contacts on the modes of all tubes too, the dense way.
#include "bench/bundle_scene.hpp"
#include "bench/thread_time.hpp"
#include "post/contact_statistics.hpp"
#include "transient/run.hpp"
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sys/resource.h>
#include <vector>

namespace {

using namespace fretwork;

struct Cost {
  double set_up = 0.0, run = 0.0;   ///< s
  double steps = 0.0, closed = 0.0; ///< mean number of closed contacts
  double touching = 0.0;            ///< of them between tubes
};

Cost cost_of(const bench::BundleScene& bundle) {
  Cost out;
  const double begin = bench::thread_seconds();
  const transient::Scene scene = bench::bundle_scene(bundle);
  transient::StepOptions options;
  options.scheme = transient::SchemeKind::splitting;
  const auto choice = transient::choose_step(scene, options);
  post::ContactStatistics statistics(scene.contacts, 0.02 * bundle.duration);
  transient::Observer* observers[] = {&statistics};
  transient::Run run(scene, choice, observers, nullptr, {});
  const double ready = bench::thread_seconds();
  while (run.advance(1000))
    ;
  const auto report = run.finish();
  out.set_up = ready - begin;
  out.run = bench::thread_seconds() - ready;
  out.steps = static_cast<double>(report.counts.steps);
  const auto summaries = statistics.summaries();
  for (std::size_t c = 0; c < summaries.size(); ++c) {
    out.closed += summaries[c].contact_time_ratio;
    if (static_cast<int>(c) >= bundle.tubes * bundle.supports)
      out.touching += summaries[c].contact_time_ratio;
  }
  return out;
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void row(const char* name, const bench::BundleScene& bundle, double apart) {
  const Cost c = cost_of(bundle);
  const double all = c.set_up + c.run;
  std::printf("| %d | %s | %.3f | %.3f | %.2f | %.0f | %.1f | %.2f | %.0f |\n", bundle.tubes, name, c.set_up,
              c.run, apart > 0.0 ? all / apart : 1.0, 1e9 * c.run / c.steps / bundle.tubes, c.closed,
              c.touching, peak_megabytes());
  std::fflush(stdout);
}

} // namespace

int main(int count, char** arguments) {
  std::vector<int> tubes;
  bool together = false;
  for (int i = 1; i < count; ++i)
    if (std::strcmp(arguments[i], "together") == 0)
      together = true;
    else
      tubes.push_back(std::atoi(arguments[i]));
  if (tubes.empty())
    tubes = {4, 9, 25, 49, 100};
  std::printf(
      "| tubes | contacts between tubes | set-up s | run s | over apart | ns/step/tube | closed | closed "
      "between tubes | peak MB |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::vector<double> logs[2];
  for (const int n : tubes) {
    bench::BundleScene bundle;
    bundle.tubes = n;
    bundle.joined = false;
    const Cost apart = cost_of(bundle);
    const double base = apart.set_up + apart.run;
    std::printf("| %d | none | %.3f | %.3f | 1.00 | %.0f | %.1f | %.2f | %.0f |\n", n, apart.set_up,
                apart.run, 1e9 * apart.run / apart.steps / n, apart.closed, apart.touching, peak_megabytes());
    bundle.joined = true;
    const Cost joined = cost_of(bundle);
    std::printf("| %d | by tube | %.3f | %.3f | %.2f | %.0f | %.1f | %.2f | %.0f |\n", n, joined.set_up,
                joined.run, (joined.set_up + joined.run) / base, 1e9 * joined.run / joined.steps / n,
                joined.closed, joined.touching, peak_megabytes());
    std::fflush(stdout);
    logs[0].push_back(std::log(n));
    logs[1].push_back(std::log(joined.set_up + joined.run));
    if (together) {
      bundle.by_tube = false;
      row("on all modes", bundle, base);
    }
  }
  if (tubes.size() > 1)
    std::printf("\nslope of the logarithms, first to last: %.2f\n",
                (logs[1].back() - logs[1].front()) / (logs[0].back() - logs[0].front()));
}
