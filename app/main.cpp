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
#include <optional>
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
  if (speaks())
    (void)program.exit(reason); // prints the text
  if (std::cout.flush())
    return reason.get_exit_code() == 0 ? 0 : input_is_wrong;
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

/// The commands and their options, and what they do.
class CommandLine {
public:
  CommandLine() {
    program_.name("fretwork");
    program_.set_version_flag("--version", FRETWORK_VERSION);
    program_.require_subcommand(
        0, 1); // that there is one is checked by parse: a word that is no command is then named
    program_.footer(
        "Exit status: 0 done, 1 the input is wrong, 2 the computation failed, 3 a defect of the program.");
    add_stages();
    add_sweeps();
    add_commands_on_results();
  }

  /// @return the status where there is nothing to be done: help, version, a wrong command line
  [[nodiscard]] std::optional<int> parse(int argc, char** argv) {
    try {
      program_.parse(argc, argv);
    } catch (const CLI::ExtrasError& error) {
      if (const std::string word = argv[1]; program_.get_subcommands().empty() && !word.starts_with("-"))
        return unknown_command(word);
      return ended_by(program_, error);
    } catch (const CLI::ParseError& error) {
      return ended_by(program_, error);
    }
    if (!program_.get_subcommands().empty())
      return {};
    if (speaks())
      fmt::print(stderr,
                 "fretwork: a command is missing; give one of run, sweep, mesh, modes, stability, response, "
                 "transient, check, report, export, compare (--help explains them)\n");
    return input_is_wrong;
  }

  [[nodiscard]] bool is_on_results() const {
    return report_->parsed() || export_->parsed() || compare_->parsed();
  }

  /// The status of report, export or compare, which one process does without MPI: it writes the files.
  [[nodiscard]] int work_on_results() {
    if (!speaks())
      return 0;
    if (compare_->parsed())
      return guarded([&] { fmt::print("{}", app::compare_results(compared_, comparison_page_)); });
    if (export_->parsed())
      return guarded([&] { fmt::print("{}", app::export_results(exported_)); });
    return guarded([&] {
      if (std::filesystem::exists(directory_ / "table.h5"))
        app::write_sweep_report(directory_);
      else
        app::write_report(directory_);
      fmt::print("written: {}\n", (directory_ / "report.html").string());
    });
  }

  /// Collective, with MPI: the status of the other commands.
  [[nodiscard]] int work_on_study() {
    request_.report = !no_report_;
    if (check_->parsed())
      return speaks() ? guarded([&] { app::check(request_); }) : 0;
    if (sweep_->parsed())
      return guarded([&] {
        const auto part = shard_.empty() ? std::nullopt : std::optional(sweep::shard_of(shard_));
        app::run_sweep(MPI_COMM_WORLD, {request_, part, gather_});
      });
    if (cases_->parsed())
      return guarded([&] { app::serve_cases(request_, with_warnings_); });
    request_.report = request_.report && run_->parsed();
    return guarded([&] { app::run_chain(MPI_COMM_WORLD, request_, last_stage()); });
  }

private:
  /// The chain, to its end or to one of its stages.
  void add_stages() {
    const auto add = [&](const char* name, const char* text) {
      CLI::App* command = program_.add_subcommand(name, text);
      add_run_options(*command, request_);
      return command;
    };
    run_ = add("run", "the whole chain: mesh, modes, transient, results, report");
    run_->add_flag("--no-report", no_report_, "do not write report.html");
    mesh_ = add("mesh", "read or make the mesh");
    modes_ = add("modes", "up to the modes of vibration");
    stability_ =
        add("stability", "fluid-elastic stability of tubes in their flow, on modes pinned at supports");
    response_ =
        add("response",
            "linear response to turbulence by spectra, on modes pinned at supports, without a transient");
    (void)add("transient", "up to the results of the transient, without report");
    check_ =
        program_.add_subcommand("check", "all that a run does before its first step: what it would refuse, "
                                         "how long it would be, what it would write");
    add_study_options(*check_, request_);
  }

  void add_sweeps() {
    sweep_ = program_.add_subcommand("sweep", "the cases of [sweep]: draws of what is uncertain, their "
                                              "table, quantiles and sensitivities");
    add_run_options(*sweep_, request_);
    sweep_->add_flag("--no-report", no_report_, "do not write report.html");
    sweep_->add_option("--shard", shard_, "i/n: part i of n of the cases only, without table (job arrays)");
    sweep_->add_flag("--gather", gather_, "no case: the table of what the shards have");
    cases_ = program_.add_subcommand("sweep-cases", "the process that computes cases for a sweep")->group("");
    add_run_options(*cases_, request_);
    cases_->add_flag("--warnings", with_warnings_, "tell what the study as it stands warns of");
  }

  void add_commands_on_results() {
    report_ =
        program_.add_subcommand("report", "report.html with its pictures, from the results in a folder");
    report_->add_option("directory", directory_, "folder of the results")->required();
    export_ = program_.add_subcommand("export", "results in other formats: DIR/export-<format>/");
    export_->add_option("directory", exported_.directory, "folder of the results")->required();
    export_
        ->add_option(
            "--format", exported_.format,
            "csv: time series and wear; vtu: modes, moving structure and contact forces for ParaView; "
            "msh: mode shapes for gmsh")
        ->check(CLI::IsMember({"csv", "vtu", "msh"}));
    export_->add_option("--from", exported_.window.from,
                        "of vtu: the first time, s (default: the first output)");
    export_->add_option("--to", exported_.window.to, "of vtu: the last time, s (default: the last output)");
    export_->add_option("--every", exported_.window.every,
                        "of vtu: every n-th output (default: 200 outputs at most, evenly spread)");
    compare_ = program_.add_subcommand(
        "compare", "what differs between runs: inputs, frequencies, work rates with significance, wear");
    compare_->add_option("directories", compared_, "folders of the results; the first is the reference")
        ->required();
    compare_->add_option("--html", comparison_page_, "write the comparison with pictures to this file too");
  }

  [[nodiscard]] int unknown_command(const std::string& word) const {
    std::vector<std::string> commands;
    for (const CLI::App* known :
         program_.get_subcommands([](const CLI::App* listed) { return !listed->get_group().empty(); }))
      commands.push_back(known->get_name());
    if (speaks())
      fmt::print(stderr, "fretwork: there is no command \"{}\"{}\n", word,
                 core::name_help(word, commands, "commands"));
    return input_is_wrong;
  }

  [[nodiscard]] app::Stage last_stage() const {
    return mesh_->parsed()        ? app::Stage::mesh
           : modes_->parsed()     ? app::Stage::modes
           : stability_->parsed() ? app::Stage::stability
           : response_->parsed()  ? app::Stage::response
                                  : app::Stage::transient;
  }

  CLI::App program_{
      "Fretwork: from a line mesh of a vibrating structure to its impacts, friction and wear.\n\n"
      "A study is one TOML file (doc/study-file.md). Start from an example:\n"
      "  fretwork run examples/tube_study/study.toml\n"
      "  fretwork check study.toml\n"
      "  mpirun -n 2 fretwork run study.toml --set transient.duration=1"};
  CLI::App *run_ = nullptr, *mesh_ = nullptr, *modes_ = nullptr, *stability_ = nullptr, *response_ = nullptr,
           *check_ = nullptr, *sweep_ = nullptr, *cases_ = nullptr, *report_ = nullptr, *export_ = nullptr,
           *compare_ = nullptr;
  app::Request request_;
  bool no_report_ = false, gather_ = false, with_warnings_ = false;
  std::string shard_;
  std::filesystem::path directory_; ///< of report
  app::ExportRequest exported_;
  std::vector<std::filesystem::path> compared_;
  std::string comparison_page_;
};

} // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF,
               0); // each line is seen when it is written, also in a log or by Python
  CommandLine line;
  if (const std::optional<int> status = line.parse(argc, argv))
    return *status;
  if (line.is_on_results())
    return line.work_on_results();
  const core::MpiSession mpi(argc, argv);
  return line.work_on_study();
}
