// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "results/beam_fields.hpp"
#include "results/mode_fields.hpp"
#include "results/output_window.hpp"
#include "results/text_file.hpp"
#include "results/vtu_file.hpp"
#include "results/write.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace fretwork::results {
namespace {

namespace fs = std::filesystem;

/// The structure at an instant, as a file.
class Structure {
public:
  explicit Structure(const RunResults& results) : lone_(lone_nodes(results)) {
    Field points(3, static_cast<Eigen::Index>(results.nodes.size()));
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      points.col(i) = results.nodes[static_cast<std::size_t>(i)];
    grid_ = vtu::grid(points, results.lines, lone_);
    if (results.beams.empty())
      return;
    beams_.emplace(results);
    point_data_ = vtu::array("radius [m]", beams_->radius()) + frames(beams_->of_nodes());
    const Frames& of = beams_->of_beams();
    cell_data_ = frames({cells(of.x, 0.0), cells(of.y, 0.0), cells(of.z, 0.0)});
  }

  [[nodiscard]] std::string at_rest(const std::string& point_data) const {
    return vtu::file(grid_, point_data + point_data_, cell_data_);
  }

  [[nodiscard]] std::string moved(const Motion& motion) const {
    const std::string moved = vtu::array("displacement [m]", motion.topRows<3>()) +
                              vtu::array("rotation [rad]", motion.bottomRows<3>());
    return vtu::file(grid_, moved + point_data_, forces(motion) + cell_data_);
  }

private:
  static std::string frames(const Frames& frames) {
    return vtu::array("x_loc", frames.x) + vtu::array("y_loc", frames.y) + vtu::array("z_loc", frames.z);
  }

  /// Of all cells: those of the beams, then those of lone nodes.
  [[nodiscard]] Eigen::MatrixXd cells(const Eigen::MatrixXd& of_beams, double of_lone_nodes) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Constant(
        of_beams.rows(), of_beams.cols() + static_cast<Eigen::Index>(lone_.size()), of_lone_nodes);
    all.leftCols(of_beams.cols()) = of_beams;
    return all;
  }

  [[nodiscard]] std::string forces(const Motion& motion) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!beams_)
      return {};
    const BeamFields::Forces forces = beams_->forces(motion);
    std::string text;
    Eigen::Index row = 0;
    for (const char* name : {"N [N]", "Vy [N]", "Vz [N]", "T [N m]", "My [N m]", "Mz [N m]"})
      text += vtu::array(name, cells(forces.middle.row(row++), none));
    return text + vtu::array("stress [Pa]", cells(forces.stress, none));
  }

  std::vector<core::Index> lone_;
  vtu::Grid grid_;
  std::optional<BeamFields> beams_;
  std::string point_data_, cell_data_; ///< what does not move
};

/// The contacts that have series, as points; forces are those on the node, global axes.
class Contacts {
public:
  explicit Contacts(const RunResults& results) {
    for (const post::ContactSeries& series : results.series.contacts)
      for (std::size_t c = 0; c < results.contacts.size(); ++c)
        if (results.contacts[c].name == series.name) {
          points_.push_back({&results.contacts[c], &series});
          numbers_.push_back(static_cast<std::int64_t>(c));
        }
    Field places(3, static_cast<Eigen::Index>(points_.size()));
    std::vector<core::Index> vertices;
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      places.col(i) = points_[static_cast<std::size_t>(i)].facts->point.place;
      vertices.push_back(static_cast<core::Index>(i));
    }
    grid_ = vtu::grid(places, {}, vertices);
  }

  [[nodiscard]] bool empty() const { return points_.empty(); }

  [[nodiscard]] std::string moved(const Motion& motion, Eigen::Index index) const {
    const auto count = static_cast<Eigen::Index>(points_.size());
    Field displacement = Field::Zero(3, count), normal(3, count), friction(3, count);
    Eigen::RowVectorXd gap(count);
    std::vector<std::int64_t> state;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& [facts, series] = points_[static_cast<std::size_t>(i)];
      for (const fem::NodeShare& share : facts->point.motion)
        displacement.col(i) += share.weights * motion.col(share.node);
      const core::Vec3 n(0.0, series->normal(index, 0), series->normal(index, 1)),
          along = core::Vec3::UnitX();
      const auto tangential = series->tangential_force.row(index);
      normal.col(i) = facts->axes.transpose() * (series->normal_force(index) * n);
      friction.col(i) = facts->axes.transpose() * (tangential(0) * along + tangential(1) * n.cross(along));
      gap(i) = series->gap(index);
      state.push_back(series->state[static_cast<std::size_t>(index)]);
    }
    return vtu::file(grid_,
                     vtu::array("displacement [m]", displacement) + vtu::array("normal force [N]", normal) +
                         vtu::array("friction force [N]", friction) +
                         vtu::array("contact force [N]", normal + friction) + vtu::array("gap [m]", gap) +
                         vtu::array("state", state) + vtu::array("contact", numbers_));
  }

private:
  struct Point {
    const ContactFacts* facts;
    const post::ContactSeries* series;
  };
  std::vector<Point> points_;
  std::vector<std::int64_t> numbers_; ///< in summary.json
  vtu::Grid grid_;
};

/// Files of one name in a folder of their own, and the collection that names them.
class Series {
public:
  Series(fs::path directory, std::string folder, std::string stem)
      : directory_(std::move(directory)), folder_(std::move(folder)), stem_(std::move(stem)) {}

  void remove_earlier() const {
    fs::remove(directory_ / (folder_ + ".pvd"));
    if (!fs::is_directory(directory_ / folder_))
      return;
    std::vector<fs::path> earlier;
    for (const auto& file : fs::directory_iterator(directory_ / folder_))
      if (file.path().filename().string().starts_with(stem_) && file.path().extension() == ".vtu")
        earlier.push_back(file.path());
    for (const fs::path& file : earlier)
      fs::remove(file);
  }

  void add(double time, const std::string& text) {
    files_.emplace_back(time, fmt::format("{}/{}_{:04}.vtu", folder_, stem_, files_.size()));
    write_text(directory_ / files_.back().second, text);
    bytes_ += static_cast<double>(text.size());
  }

  /// @return bytes of all files
  double close() const {
    const std::string text = vtu::collection(files_);
    write_text(directory_ / (folder_ + ".pvd"), text);
    return bytes_ + static_cast<double>(text.size());
  }

private:
  fs::path directory_;
  std::string folder_, stem_;
  std::vector<std::pair<double, std::string>> files_;
  double bytes_ = 0.0;
};

void check_space(const fs::path& directory, double bytes, std::size_t count) {
  constexpr double giga = 1e9;
  std::error_code unknown;
  const fs::space_info space = fs::space(directory, unknown);
  if (!unknown && bytes > static_cast<double>(space.available))
    throw core::Error(fmt::format(
        "{}: {} instants take {:.3g} GB, and {:.3g} GB are free; take fewer by --every, --from and --to",
        directory.string(), count, bytes / giga, static_cast<double>(space.available) / giga));
}

} // namespace

VtuSeries export_vtu(const fs::path& directory, const RunResults& results, const OutputWindow& window) {
  require_mesh(results);
  const post::TimeSeries& series = results.series;
  const bool moves = series.modal_displacement.size() > 0;
  if (!moves && window.given())
    throw core::Error(
        "--from, --to and --every choose from series of the modes, and these results hold none; run the "
        "study with a [transient] and without output.modal = false");
  const std::vector<Eigen::Index> chosen =
      moves ? outputs_of(window, series.time) : std::vector<Eigen::Index>();
  const Structure structure(results);
  const Contacts contacts(results);
  if (moves) {
    const Motion first = motion(results, chosen.front());
    const std::size_t bytes =
        structure.moved(first).size() + (contacts.empty() ? 0 : contacts.moved(first, chosen.front()).size());
    check_space(directory, static_cast<double>(bytes * chosen.size()), chosen.size());
  }
  Series snapshots(directory, "snapshots", "snapshot"), forces(directory, "contacts", "contacts");
  snapshots.remove_earlier();
  forces.remove_earlier();

  std::string modes;
  for (Eigen::Index k = 0; k < mode_count(results); ++k) {
    const ModeField field = mode_field(results, k);
    modes += vtu::array(field.name, field.displacement);
  }
  const std::string at_rest = structure.at_rest(modes);
  write_text(directory / "modes.vtu", at_rest);
  VtuSeries out;
  out.bytes = static_cast<double>(at_rest.size());
  if (!moves)
    return out;
  out.contacts = !contacts.empty();
  for (const Eigen::Index index : chosen) {
    const Motion here = motion(results, index);
    snapshots.add(series.time(index), structure.moved(here));
    if (out.contacts)
      forces.add(series.time(index), contacts.moved(here, index));
  }
  out.bytes += snapshots.close() + (out.contacts ? forces.close() : 0.0);
  out.count = static_cast<Eigen::Index>(chosen.size());
  out.outputs = series.time.size();
  out.from = series.time(chosen.front());
  out.to = series.time(chosen.back());
  return out;
}

} // namespace fretwork::results
