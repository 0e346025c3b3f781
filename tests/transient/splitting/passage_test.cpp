// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/passage.hpp"
#include <gtest/gtest.h>

namespace passage_test {

using namespace fretwork::transient;

TEST(Passage, FollowsFromWhatHappensInTheInterval) {
  struct Case {
    PassageConditions conditions; ///< was_closed, rolls_round, crosses, has_force, force_ends
    Passage passage;
    bool touches, departs, ends_closed;
  };
  for (const Case& c : {Case{{false, false, false, false, false}, Passage::stays_open, false, false, false},
                        {{false, false, false, false, true}, Passage::stays_open, false, false, false},
                        {{false, false, true, true, false}, Passage::closes, true, false, true},
                        {{false, false, false, true, false}, Passage::closes, true, false, true},
                        {{false, false, false, true, true}, Passage::closes_and_opens, true, true, false},
                        {{true, false, false, true, false}, Passage::stays_closed, false, false, true},
                        {{true, false, false, true, true}, Passage::opens, false, true, false},
                        {{true, false, false, false, false}, Passage::opens, false, true, false},
                        {{true, false, true, false, false}, Passage::opens, false, true, false},
                        {{true, false, true, true, false}, Passage::crosses, true, false, true},
                        {{true, false, true, true, true}, Passage::crosses_and_opens, true, true, false},
                        {{true, true, false, true, false}, Passage::rolls_round, false, false, true},
                        {{true, true, true, true, true}, Passage::rolls_round, false, false, true},
                        {{true, true, true, false, false}, Passage::rolls_round, false, false, true}}) {
    const auto& [was_closed, rolls_round, opposite, has_force, force_ends] = c.conditions;
    SCOPED_TRACE(testing::Message() << was_closed << rolls_round << opposite << has_force << force_ends);
    EXPECT_EQ(passage_of(c.conditions), c.passage);
    EXPECT_EQ(touches(c.passage), c.touches);
    EXPECT_EQ(departs(c.passage), c.departs);
    EXPECT_EQ(ends_closed(c.passage), c.ends_closed);
  }
}

} // namespace passage_test
