// SPDX-License-Identifier: GPL-3.0-or-later
// [[turbulence]] and [[response]] as values, and every message about them.
#include "folder.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::turbulence_test {
namespace {

const std::string flow =
    "[mesh]\nfile = \"a.msh\"\n[[flow]]\ngroup = \"tube\"\nfrom = \"foot\"\n[[flow.zones]]\n"
    "density = 740\nviscosity = 1.23e-7\nvelocity = [0, 0, 1]\n";
std::string turbulence(const std::string& more) {
  return flow + "[[turbulence]]\ncorrelation_length = 0.06\n" + more;
}
const std::string cor_3 = "spectrum = \"cor_3\"\n";

TEST(TurbulenceKeys, HaveTheirDefaults) {
  const Study study = read_text(turbulence(cor_3));
  const Turbulence& t = study.turbulence.at(0);
  EXPECT_EQ(t.name, "turbulence 1");
  EXPECT_TRUE(t.flows.empty());
  EXPECT_TRUE(t.zones.empty());
  EXPECT_TRUE(std::holds_alternative<flow::Cor3>(t.spectrum));
  EXPECT_EQ(t.correlation_length, 0.06);
  EXPECT_EQ(t.lift, 1.0);
  EXPECT_EQ(t.drag, 1.0);
  EXPECT_EQ(t.scaling, flow::Scaling::local);
  EXPECT_FALSE(t.running_velocity);
  EXPECT_FALSE(t.two_sided);
  EXPECT_FALSE(t.band);
  EXPECT_EQ(t.seed, 1u);
  EXPECT_EQ(t.ramp, 0.0);
}

TEST(TurbulenceKeys, AreReadWithTheirValues) {
  const Study study = read_text(turbulence("name = \"inlet\"\nflow = \"tube\"\nzones = [\"1\"]\nspectrum = "
                                           "\"cor_2\"\nconstants = { phi0 = 2e-3, beta = 3 }\n"
                                           "lift = 0.5\ndrag = 2\nscaling = \"zone_mean\"\nrunning_velocity "
                                           "= 1.5\ntwo_sided = true\nband = [2, 80]\nseed = 9\n"
                                           "ramp = 0.2\n"));
  const Turbulence& t = study.turbulence.at(0);
  EXPECT_EQ(t.name, "inlet");
  EXPECT_EQ(t.flows, std::vector<std::string>{"tube"});
  EXPECT_EQ(t.zones, std::vector<std::string>{"1"});
  const auto& spectrum = std::get<flow::Cor2>(t.spectrum);
  EXPECT_EQ(spectrum.phi0, 2e-3);
  EXPECT_EQ(spectrum.f_c, 0.1);
  EXPECT_EQ(spectrum.beta, 3.0);
  EXPECT_EQ(t.lift, 0.5);
  EXPECT_EQ(t.drag, 2.0);
  EXPECT_EQ(t.scaling, flow::Scaling::zone_mean);
  EXPECT_EQ(t.running_velocity, 1.5);
  EXPECT_TRUE(t.two_sided);
  EXPECT_EQ(t.band->low, 2.0);
  EXPECT_EQ(t.band->high, 80.0);
  EXPECT_EQ(t.seed, 9u);
  EXPECT_EQ(t.ramp, 0.2);
}

TEST(TurbulenceKeys, NameEverySpectrum) {
  for (const char* name : {"cor_1", "cor_2", "cor_3", "axisa", "interior", "inlet", "two_phase"}) {
    const Study study = read_text(turbulence("spectrum = \"" + std::string(name) + "\"\n"));
    EXPECT_EQ(flow::name_of(study.turbulence.at(0).spectrum), name);
  }
  const Study four =
      read_text(turbulence("spectrum = \"cor_4\"\nband = [1, 50]\nconstants = { gamma = 3 }\n"));
  EXPECT_EQ(std::get<flow::Cor4>(four.turbulence.at(0).spectrum).gamma, 3.0);
}

TEST(TurbulenceKeys, TakeTablesInlineOrFromFiles) {
  const Folder folder;
  folder.write("psd.csv", "f,G\n1, 2\n10, 0.5\n");
  const auto study_of = [&](const std::string& table) {
    return read(
        folder.write("study.toml", turbulence("spectrum = \"table\"\ntable_frequency = \"hz\"\n" + table)));
  };
  for (const char* table : {"table = \"psd.csv\"\n", "table = [[1, 2], [10, 0.5]]\n"}) {
    const Study study = study_of(table);
    const auto& spectrum = std::get<flow::TableSpectrum>(study.turbulence.at(0).spectrum);
    EXPECT_EQ(spectrum.x, (std::vector<double>{1, 10}));
    EXPECT_EQ(spectrum.y, (std::vector<double>{2, 0.5}));
    EXPECT_TRUE(spectrum.absolute);
  }
  // what a stage depends on are the rows, not the name of the file
  folder.write("study.toml", turbulence("spectrum = \"table\"\ntable = \"psd.csv\"\n"));
  const std::string text = canonical_text(folder.path() / "study.toml", {}, {"turbulence"});
  EXPECT_EQ(text.find("psd.csv"), std::string::npos) << text;
}

TEST(TurbulenceKeys, AreRefusedWithTheCure) {
  const struct {
    std::string keys;
    const char* expected;
  } cases[] = {
      {"", "spectrum"},
      {"spectrum = \"cor_9\"\n", "cor_3"},
      {"spectrum = \"cor_4\"\n", "band = [low, high]"},
      {"spectrum = \"cor_4\"\nband = [0, 10]\n", "low > 0"},
      {"spectrum = \"cor_1\"\nconstants = { phi0 = 1 }\n", "none that may be set"},
      {"spectrum = \"cor_2\"\nconstants = { phi = 1 }\n", "did you mean \"phi0\""},
      {"spectrum = \"cor_2\"\nconstants = { phi0 = 0 }\n", "> 0"},
      {cor_3 + "table = [[1, 1], [2, 1]]\n", "belongs to spectrum = \"table\""},
      {"spectrum = \"table\"\n", "table"},
      {"spectrum = \"table\"\ntable = [[1, 1]]\n", "two rows at least"},
      {"spectrum = \"table\"\ntable = [[1, 1], [1, 2]]\n", "frequencies rise"},
      {"spectrum = \"table\"\ntable = [[1, 1], [2, 0]]\n", "not above zero"},
      {"spectrum = \"table\"\ntable = \"nothing.csv\"\n", "nothing.csv"},
      {cor_3 + "lift = 0\ndrag = 0\n", "weight above 0"},
      {cor_3 + "lift = -1\n", ">= 0"},
      {cor_3 + "running_velocity = 1\n", "zone_mean"},
      {cor_3 + "band = [9, 2]\n", "[low, high]"},
      {cor_3 + "seed = 4294967296\n", "below 2^32"},
      {cor_3 + "correlation_lenght = 1\n", "did you mean \"correlation_length\""},
      {cor_3 + "ramp = -1\n", ">= 0"},
      {cor_3 + "[[turbulence]]\nname = \"turbulence 1\"\ncorrelation_length = 1\nspectrum = \"cor_3\"\n",
       "a name of its own"},
  };
  for (const auto& c : cases) {
    const std::string message = message_of(turbulence(c.keys));
    EXPECT_NE(message.find("turbulence"), std::string::npos) << c.keys << "\n" << message;
    EXPECT_NE(message.find(c.expected), std::string::npos) << c.keys << "\n" << message;
  }
  EXPECT_NE(message_of("[mesh]\nfile = \"a.msh\"\n[[turbulence]]\ncorrelation_length = 1\n" + cor_3)
                .find("[[flow]]"),
            std::string::npos);
}

TEST(ResponseKeys, AreReadAndRefused) {
  const Study study =
      read_text(turbulence(cor_3 + "[[response]]\n[[response]]\nname = \"free\"\npinned = \"none\"\n"
                                   "damping = 0.01\nduration = 60\nprobability = 0.9\n"));
  ASSERT_EQ(study.responses.size(), 2u);
  EXPECT_EQ(study.responses[0].name, "response 1");
  EXPECT_EQ(study.responses[0].pinned, Pinned::contacts);
  EXPECT_EQ(study.responses[0].duration, 3600.0);
  EXPECT_EQ(study.responses[0].probability, 0.5);
  EXPECT_EQ(study.responses[1].pinned, Pinned::none);
  EXPECT_EQ(study.responses[1].damping, 0.01);
  EXPECT_EQ(study.responses[1].duration, 60.0);
  EXPECT_EQ(study.responses[1].probability, 0.9);
  for (const auto& [keys, expected] : std::vector<std::pair<std::string, std::string>>{
           {"damping = 1\n", "below 1"},
           {"probability = 1\n", "below 1"},
           {"duration = 0\n", "> 0"},
           {"pinned = [\"tsp\"]\n", "no contact is called so"},
           {"name = \"a\"\n[[response]]\nname = \"a\"\n", "a name of its own"}}) {
    const std::string message = message_of(turbulence(cor_3 + "[[response]]\n" + keys));
    EXPECT_NE(message.find(expected), std::string::npos) << keys << "\n" << message;
  }
  EXPECT_NE(message_of(flow + "[[response]]\n").find("[[turbulence]]"), std::string::npos);
}

} // namespace
} // namespace fretwork::study::turbulence_test
