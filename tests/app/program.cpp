// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"
#include "core/child_process.hpp"
#include "paths.hpp"
#include "results/write.hpp"
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace fretwork::app::test {
namespace {

constexpr const char* longest_run = "60"; ///< s: a run that hangs fails, it does not hang the tests

template <class Series> const Series& named(const std::vector<Series>& all, const std::string& name) {
  for (const Series& series : all)
    if (series.name == name)
      return series;
  throw std::runtime_error("no series of " + name);
}

bool same(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a.array() == b.array()).all();
}

} // namespace

const post::ContactSeries& Results::contact(const std::string& name) const {
  return named(archive.series.contacts, name);
}

const post::NodeSeries& Results::node(const std::string& name) const {
  return named(archive.series.nodes, name);
}

const nlohmann::json& Results::statistics(const std::string& name) const {
  for (const auto& contact : summary.at("contacts"))
    if (contact.at("name") == name)
      return contact;
  throw std::runtime_error("no contact " + name);
}

EnvironmentVariable::EnvironmentVariable(std::string name, const std::string& value)
    : name_(std::move(name)) {
  if (const char* before = std::getenv(name_.c_str()))
    before_ = before;
  setenv(name_.c_str(), value.c_str(), 1);
}

EnvironmentVariable::~EnvironmentVariable() {
  if (before_)
    setenv(name_.c_str(), before_->c_str(), 1);
  else
    unsetenv(name_.c_str());
}

Workshop::Workshop() {
  std::string pattern = (fs::temp_directory_path() / "fretwork_app_XXXXXX").string();
  if (!mkdtemp(pattern.data()))
    throw std::runtime_error("no temporary folder");
  folder_ = pattern;
}

Workshop::~Workshop() { fs::remove_all(folder_); }

fs::path Workshop::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

Outcome Workshop::fretwork(const std::vector<std::string>& arguments, int ranks) const {
  const std::string out = path("stdout").string(), err = path("stderr").string();
  std::vector<std::string> all{"sh", "-c", "exec \"$@\" >" + out + " 2>" + err, "sh", "timeout", longest_run};
  if (ranks > 0)
    for (const std::string& word :
         {std::string("mpirun"), std::string("--oversubscribe"), std::string("-n"), std::to_string(ranks)})
      all.push_back(word);
  all.push_back((test_paths::binary_dir() / "bin" / "fretwork").string());
  all.insert(all.end(), arguments.begin(), arguments.end());
  const int status = core::run_child(all).status;
  return {status, bytes_of(out), bytes_of(err)};
}

Results Workshop::run(const fs::path& study, const std::string& output, const std::vector<std::string>& more,
                      int ranks) const {
  std::vector<std::string> arguments{"run", study.string(), "--no-report", "-o", path(output).string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = fretwork(arguments, ranks);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return read_results(path(output));
}

Results Workshop::run_text(const std::string& study, const std::vector<std::string>& more, int ranks) const {
  return run(write("study.toml", study), "results", more, ranks);
}

Results read_results(const fs::path& directory) {
  return {nlohmann::json::parse(bytes_of(directory / "summary.json")), results::read_archive(directory)};
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path example(const std::string& name) {
  return test_paths::source_dir() / "examples" / name / "study.toml";
}

testing::AssertionResult says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos)
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << text << "\" does not contain \"" << part << "\"";
}

testing::AssertionResult close_to(double value, double reference, double tolerance) {
  const double error = std::abs(value - reference) / std::abs(reference);
  auto result = error <= tolerance ? testing::AssertionSuccess() : testing::AssertionFailure();
  return result << value << " differs from " << reference << " by " << error << " relative";
}

nlohmann::json lasting(nlohmann::json summary) {
  summary.erase("timings_s");
  summary.erase("ranks");
  summary.erase("sha256");
  return summary;
}

testing::AssertionResult same_numbers(const results::RunResults& a, const results::RunResults& b) {
  const auto differ = [](const std::string& what) {
    return testing::AssertionFailure() << what << " differ";
  };
  const post::TimeSeries &s = a.series, &t = b.series;
  if (!same(s.time, t.time) || !same(s.modal_displacement, t.modal_displacement) ||
      !same(s.modal_velocity, t.modal_velocity))
    return differ("times or modal series");
  if (s.contacts.size() != t.contacts.size() || s.nodes.size() != t.nodes.size() ||
      a.bases.size() != b.bases.size())
    return differ("numbers of contacts, nodes or structures");
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    const auto &x = s.contacts[c], &y = t.contacts[c];
    if (x.name != y.name || !same(x.displacement, y.displacement) || !same(x.velocity, y.velocity) ||
        !same(x.gap, y.gap) || !same(x.normal_force, y.normal_force) ||
        !same(x.tangential_force, y.tangential_force) || !same(x.normal, y.normal))
      return differ("series of contact " + x.name);
  }
  for (std::size_t n = 0; n < s.nodes.size(); ++n) {
    const auto &x = s.nodes[n], &y = t.nodes[n];
    if (x.name != y.name || !same(x.displacement, y.displacement) || !same(x.velocity, y.velocity) ||
        !same(x.acceleration, y.acceleration))
      return differ("series of node " + x.name);
  }
  if (s.reactions.size() != t.reactions.size())
    return differ("numbers of reactions");
  for (std::size_t k = 0; k < s.reactions.size(); ++k)
    if (s.reactions[k].name != t.reactions[k].name || !same(s.reactions[k].force, t.reactions[k].force))
      return differ("series of reaction " + s.reactions[k].name);
  for (std::size_t i = 0; i < a.bases.size(); ++i)
    if (!same(a.bases[i].omega, b.bases[i].omega) || !same(a.bases[i].shapes, b.bases[i].shapes))
      return differ("modes of structure " + std::to_string(i));
  return testing::AssertionSuccess();
}

} // namespace fretwork::app::test
