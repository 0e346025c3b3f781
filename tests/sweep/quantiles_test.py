# SPDX-License-Identifier: GPL-3.0-or-later
"""Intervals of quantiles and probabilities cover the truth as often as they say: quantiles_test.py SWEEP_FOLDER."""

import math
import sys
import unittest

sys.path.insert(0, sys.argv.pop(1))

import numpy as np  # noqa: E402
import openturns_helper as helper  # noqa: E402

REPETITIONS, CASES, CONFIDENCE = 300, 200, 0.95
# 300 repetitions at 0.95 give 285 +- 3.8 hits; order statistics are discrete, so that their coverage lies above, by up to a case's share
FEWEST = REPETITIONS * CONFIDENCE - 3.0 * math.sqrt(REPETITIONS * CONFIDENCE * (1.0 - CONFIDENCE))
MOST = REPETITIONS * 0.995


def model(x):
    """A cheap case: the years to a limit that a work rate reaches, lognormal."""
    return 10.0 / np.exp(0.5 * x)


def truth(probability):
    from openturns import Normal

    return 10.0 * math.exp(0.5 * Normal().computeQuantile(probability)[0])


class Coverage(unittest.TestCase):
    def repetitions(self):
        for repetition in range(REPETITIONS):
            points = helper.uniforms("monte_carlo", CASES, 1, 1, repetition)
            yield model(helper.values_of({"name": "x", "law": "normal", "parameters": [0.0, 1.0]}, points[:, 0]))

    def test_quantile_intervals_cover_as_often_as_they_say(self):
        probabilities = (0.1, 0.5, 0.9)
        hits = dict.fromkeys(probabilities, 0)
        for values in self.repetitions():
            for probability in probabilities:
                _, low, high = helper.quantile_interval(values, probability, CONFIDENCE)
                hits[probability] += low <= truth(probability) <= high
        for probability, count in hits.items():
            self.assertGreaterEqual(count, FEWEST, f"{probability}: {count} of {REPETITIONS}")
            self.assertLessEqual(count, MOST, f"{probability}: {count} of {REPETITIONS}")

    def test_intervals_of_probabilities_cover_at_least_as_often(self):
        limit, hits = truth(0.9), 0
        for values in self.repetitions():
            low, high = helper.share_interval(int(np.sum(values > limit)), CASES, CONFIDENCE)
            hits += low <= 0.1 <= high
        self.assertGreaterEqual(hits, FEWEST)

    def test_intervals_of_rank_correlations_cover(self):
        hits, correlation = 0, 0.6
        for repetition in range(REPETITIONS):
            points = helper.correlated(helper.uniforms("monte_carlo", CASES, 2, 1, repetition), [[0, 1, correlation]])
            found = helper.rank_correlation(points[:, 0], points[:, 1], CONFIDENCE)
            hits += found["low"] <= correlation <= found["high"]
        self.assertGreaterEqual(hits, FEWEST - 0.02 * REPETITIONS)  # Fisher's transform is asymptotic

    def test_too_few_cases_have_no_interval(self):
        values = np.arange(58.0)
        self.assertIsNone(helper.quantile_interval(values, 0.95, 0.90)[2])  # Wilks: 59 for 95 % at 95 %, one-sided
        self.assertEqual(helper.quantile_interval(np.arange(59.0), 0.95, 0.90)[2], 58.0)

    def test_the_first_support_is_counted_by_case(self):
        never, absent = math.inf, math.nan
        lives = ["a.years", "a.support_years", "b.years"]
        cases = [[3.0, 2.0, 4.0], [1.0, 2.0, 4.0], [3.0, never, absent], [never, never, never], [absent] * 3, [never, never, 9.0], [5.0, 6.0, 7.0]]
        found = helper.first_supports(lives, np.array(cases), CONFIDENCE)
        self.assertEqual((found["cases"], found["never"]), (6, 1))
        self.assertEqual([(s["support"], s["body"], s["hits"]) for s in found["supports"]], [("a", "tube", 3), ("a", "support", 1), ("b", "tube", 1)])
        first = found["supports"][0]
        self.assertEqual(first["share"], 0.5)
        # Clopper and Pearson of 3 of 6: the binomial tails at the ends are 2.5 %
        for end, hits in (("low", range(3, 7)), ("high", range(4))):
            tail = sum(math.comb(6, k) * first[end] ** k * (1.0 - first[end]) ** (6 - k) for k in hits)
            self.assertAlmostEqual(tail, 0.025, 9)

    def test_cases_with_an_unknown_life_are_not_judged(self):
        never, none = math.inf, math.nan
        lives = ["a.years", "a.support_years", "b.years"]
        cases = [[3.0, 2.0, 4.0], [1.0, none, 4.0], [3.0, never, none], [never, never, none], [none] * 3, [5.0, 6.0, 4.0]]
        present = np.array([[True] * 3] * 2 + [[True, True, False]] + [[True] * 3] + [[False] * 3] + [[True] * 3])
        found = helper.first_supports(lives, np.array(cases), CONFIDENCE, present)
        self.assertEqual((found["cases"], found["never"], found["not_judged"]), (5, 0, 2))
        self.assertEqual(sorted((s["support"], s["body"], s["hits"]) for s in found["supports"]), [("a", "support", 1), ("a", "tube", 1), ("b", "tube", 1)])
        self.assertEqual([(s["support"], s["body"], s["cases"]) for s in found["unknown"]], [("a", "support", 1), ("b", "tube", 1)])
        # of five cases, each: one judged, and one in which it may be first; b has the shortest known life of none of them
        for first in found["supports"]:
            self.assertEqual(first["share"], 0.2)
            self.assertEqual((first["low"], first["high"]), (helper.share_interval(1, 5, CONFIDENCE)[0], helper.share_interval(2, 5, CONFIDENCE)[1]))

    def test_never_is_a_value(self):
        values = np.array([1.0] * 50 + [math.inf] * 50)
        value, low, high = helper.quantile_interval(values, 0.95, CONFIDENCE)
        self.assertEqual((value, low), (math.inf, math.inf))
        self.assertEqual(helper.finite_or_none(value, "never"), "never")


if __name__ == "__main__":
    unittest.main()
