// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The executable: command line, exit status. The only catch of the program is here.
#include "app/case_worker.hpp"
#include "app/chain.hpp"
#include "app/export.hpp"
#include "app/python_report.hpp"
#include "app/sweep.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/names.hpp"
#include "core/printable.hpp"
#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <system_error>

namespace {

using namespace fretwork;

constexpr int input_is_wrong = 1, computation_failed = 2, program_defect = 3;

/// Of an MPI job only the first process speaks, also where MPI is not initialised.
bool speaks() { return core::is_first_process(); }

/// What the input holds may be repeated in a message: it is not obeyed by the terminal, and does not fill it.
void complain(const std::string& message) {
  fmt::print(stderr, "fretwork: {}\n", core::printable(message, core::longest_message_line));
}

int guarded(const std::function<void()>& work) {
  try {
    work();
    if (std::fflush(stdout) != 0)
      throw std::system_error(errno, std::generic_category());
    return 0;
  } catch (const core::Error& error) {
    if (speaks())
      complain(error.what());
    return input_is_wrong;
  } catch (const core::ComputationError& error) {
    if (speaks())
      complain(error.what());
    return computation_failed;
  } catch (const std::filesystem::filesystem_error& error) {
    if (speaks())
      complain(fmt::format("{}; check that the folder exists and its permissions", error.what()));
    return input_is_wrong;
  } catch (const std::system_error& error) { // of standard output
    if (speaks())
      complain(fmt::format("the output cannot be written: {}", error.code().message()));
    return computation_failed;
  } catch (const std::exception& error) {
    complain(fmt::format("this is a defect of the program, please report it: {}", error.what()));
    return program_defect;
  }
}

/// The status of a command line that asked for nothing but text (help, version), or is wrong.
int ended_by(const CLI::App& program, const CLI::ParseError& reason) {
  const bool good = program.exit(reason) == 0;
  if (std::cout.flush())
    return good ? 0 : input_is_wrong;
  complain("the output cannot be written");
  return computation_failed;
}

void add_study_options(CLI::App& command, app::Request& request) {
  command.add_option("study", request.study, "the study file (TOML)")->required();
  command.add_option(
      "--set", request.overrides,
      "override a key, e.g. --set contacts.tsp1.gap=3e-4 (arrays of tables by name, group or index)");
}

void add_run_options(CLI::App& command, app::Request& request) {
  add_study_options(command, request);
  command.add_option(
      "-o,--output", request.directory,
      "folder of the results (default: the study's name with .results, of a sweep .sweep, beside it)");
  command.add_flag("--force", request.force,
                   "compute every stage again, also where nothing has changed; replace a run by what another "
                   "command gives");
  command.add_flag("-q,--quiet", request.quiet, "nothing on the terminal but errors");
}

} // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF,
               0); // each line is seen when it is written, also in a log or by Python
  CLI::App program{
      "Fretwork: from a line mesh of a vibrating structure to its impacts, friction and wear.\n\n"
      "A study is one TOML file (doc/study-file.md). Start from an example:\n"
      "  fretwork run examples/tube_study/study.toml\n"
      "  fretwork check study.toml\n"
      "  mpirun -n 2 fretwork run study.toml --set transient.duration=1"};
  program.name("fretwork");
  program.set_version_flag("--version", FRETWORK_VERSION);
  program.require_subcommand(
      0, 1); // that there is one is checked below: a word that is no command is then named
  program.footer(
      "Exit status: 0 done, 1 the input is wrong, 2 the computation failed, 3 a defect of the program.");

  app::Request request;
  bool no_report = false;
  CLI::App* run = program.add_subcommand("run", "the whole chain: mesh, modes, transient, results, report");
  add_run_options(*run, request);
  run->add_flag("--no-report", no_report, "do not write report.html");
  CLI::App* mesh = program.add_subcommand("mesh", "read or make the mesh");
  add_run_options(*mesh, request);
  CLI::App* modes = program.add_subcommand("modes", "up to the modes of vibration");
  add_run_options(*modes, request);
  CLI::App* stability = program.add_subcommand(
      "stability", "fluid-elastic stability of tubes in their flow, on modes pinned at supports");
  add_run_options(*stability, request);
  CLI::App* response = program.add_subcommand(
      "response",
      "linear response to turbulence by spectra, on modes pinned at supports, without a transient");
  add_run_options(*response, request);
  CLI::App* transient =
      program.add_subcommand("transient", "up to the results of the transient, without report");
  add_run_options(*transient, request);
  CLI::App* check =
      program.add_subcommand("check", "all that a run does before its first step: what it would refuse, how "
                                      "long it would be, what it would write");
  add_study_options(*check, request);
  std::filesystem::path directory;
  CLI::App* sweep = program.add_subcommand(
      "sweep", "the cases of [sweep]: draws of what is uncertain, their table, quantiles and sensitivities");
  add_run_options(*sweep, request);
  sweep->add_flag("--no-report", no_report, "do not write report.html");
  std::string shard;
  sweep->add_option("--shard", shard, "i/n: part i of n of the cases only, without table (job arrays)");
  bool gather = false;
  sweep->add_flag("--gather", gather, "no case: the table of what the shards have");
  CLI::App* cases =
      program.add_subcommand("sweep-cases", "the process that computes cases for a sweep")->group("");
  add_run_options(*cases, request);
  bool with_warnings = false;
  cases->add_flag("--warnings", with_warnings, "tell what the study as it stands warns of");
  CLI::App* report =
      program.add_subcommand("report", "report.html with its pictures, from the results in a folder");
  report->add_option("directory", directory, "folder of the results")->required();
  CLI::App* exporting = program.add_subcommand("export", "results in other formats: DIR/export-<format>/");
  app::ExportRequest exported;
  exporting->add_option("directory", exported.directory, "folder of the results")->required();
  exporting
      ->add_option("--format", exported.format,
                   "csv: time series and wear; vtu: modes, moving structure and contact forces for ParaView; "
                   "msh: mode shapes for gmsh")
      ->check(CLI::IsMember({"csv", "vtu", "msh"}));
  exporting->add_option("--from", exported.window.from,
                        "of vtu: the first time, s (default: the first output)");
  exporting->add_option("--to", exported.window.to, "of vtu: the last time, s (default: the last output)");
  exporting->add_option("--every", exported.window.every,
                        "of vtu: every n-th output (default: 200 outputs at most, evenly spread)");

  CLI::App* compare = program.add_subcommand(
      "compare", "what differs between runs: inputs, frequencies, work rates with significance, wear");
  std::vector<std::filesystem::path> compared;
  std::string comparison_page;
  compare->add_option("directories", compared, "folders of the results; the first is the reference")
      ->required();
  compare->add_option("--html", comparison_page, "write the comparison with pictures to this file too");

  try {
    program.parse(argc, argv);
  } catch (const CLI::ExtrasError& error) {
    if (const std::string command = argv[1]; program.get_subcommands().empty() && !command.starts_with("-")) {
      std::vector<std::string> commands;
      for (const CLI::App* known :
           program.get_subcommands([](const CLI::App* listed) { return !listed->get_group().empty(); }))
        commands.push_back(known->get_name());
      if (speaks())
        fmt::print(stderr, "fretwork: there is no command \"{}\"{}\n", command,
                   core::name_help(command, commands, "commands"));
      return input_is_wrong;
    }
    return ended_by(program, error);
  } catch (const CLI::ParseError& error) {
    return ended_by(program, error);
  }
  if (program.get_subcommands().empty()) {
    fmt::print(stderr,
               "fretwork: a command is missing; give one of run, sweep, mesh, modes, stability, response, "
               "transient, check, report, export, compare (--help explains them)\n");
    return input_is_wrong;
  }
  request.report = !no_report;
  if ((report->parsed() || exporting->parsed() || compare->parsed()) && !speaks())
    return 0; // one process writes the files
  if (report->parsed())
    return guarded([&] {
      if (std::filesystem::exists(directory / "table.h5"))
        app::write_sweep_report(directory);
      else
        app::write_report(directory);
      fmt::print("written: {}\n", (directory / "report.html").string());
    });
  if (compare->parsed())
    return guarded([&] { fmt::print("{}", app::compare_results(compared, comparison_page)); });
  if (exporting->parsed())
    return guarded([&] { fmt::print("{}", app::export_results(exported)); });

  const core::MpiSession mpi(argc, argv);
  if (check->parsed())
    return speaks() ? guarded([&] { app::check(request); }) : 0;
  if (sweep->parsed())
    return guarded([&] {
      const auto part = shard.empty() ? std::nullopt : std::optional(sweep::shard_of(shard));
      app::run_sweep(MPI_COMM_WORLD, {request, part, gather});
    });
  if (cases->parsed())
    return guarded([&] { app::serve_cases(request, with_warnings); });
  request.report = request.report && run->parsed();
  const app::Stage last = mesh->parsed()        ? app::Stage::mesh
                          : modes->parsed()     ? app::Stage::modes
                          : stability->parsed() ? app::Stage::stability
                          : response->parsed()  ? app::Stage::response
                                                : app::Stage::transient;
  static_cast<void>(transient);
  return guarded([&] { app::run_chain(MPI_COMM_WORLD, request, last); });
}
