# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws and statistics of sweeps by OpenTURNS: openturns_helper.py FOLDER, which holds request.json and takes answer.json (and values.bin).

Exit status 3: this Python lacks a module. Formulas and their limits: doc/sweep.md."""

import json
import math
import sys
from pathlib import Path

LACKS_MODULES = 3
try:
    import numpy as np
    import openturns as ot
except ImportError as missing:
    print(missing)
    sys.exit(LACKS_MODULES)

SEED_STEP = 7919  # between the seeds of blocks
SMALLEST = 2.0**-53  # distance of a uniform number from 0 and 1


class WrongInput(Exception):
    pass


# draws ----------------------------------------------------------------------------------------------------------------


def uniforms(design, count, dimension, seed, block):
    """Points of a block in the unit cube, count x dimension (saltelli: count (dimension + 2) points)."""
    if dimension == 0:
        return np.zeros((count, 0))
    ot.RandomGenerator.SetSeed((seed + SEED_STEP * block) % 2**31)
    cube = ot.ComposedDistribution([ot.Uniform(0.0, 1.0)] * dimension)
    if design == "monte_carlo":
        return np.array(ot.RandomGenerator.Generate(count * dimension)).reshape(count, dimension)
    if design == "latin_hypercube":
        return np.array(ot.LHSExperiment(cube, count, False, True).generate())
    if design == "sobol":
        ot.RandomGenerator.SetSeed(seed)
        shift = np.array(ot.RandomGenerator.Generate(dimension))
        sequence = ot.SobolSequence(dimension)
        return (np.array(sequence.generate((block + 1) * count))[block * count :] + shift) % 1.0
    if design == "saltelli":
        return np.array(ot.SobolIndicesExperiment(cube, count, False).generate())
    raise WrongInput(f'unknown design "{design}"')


def correlated(points, correlations):
    """Points of the unit cube under the normal copula with these rank correlations (Spearman)."""
    if not correlations:
        return points
    ranks = np.identity(points.shape[1])
    for first, second, value in correlations:
        ranks[first, second] = ranks[second, first] = value
    try:
        normal = np.array(ot.NormalCopula.GetCorrelationFromSpearmanCorrelation(ot.CorrelationMatrix(ranks.tolist())))
        factor = np.linalg.cholesky(normal)
    except (np.linalg.LinAlgError, RuntimeError):
        raise WrongInput("sweep.correlations: no variables can be correlated like this, the matrix is not positive definite; take smaller values")
    scores = np.column_stack([np.array(ot.Normal().computeQuantile(column.tolist()))[:, 0] for column in points.T])
    scores = scores @ factor.T
    return np.column_stack([np.array(ot.Normal().computeCDF(column.reshape(-1, 1)))[:, 0] for column in scores.T])


def distribution(name, law, parameters, truncated):
    laws = {
        "uniform": lambda a, b: ot.Uniform(a, b),
        "normal": lambda mean, deviation: ot.Normal(mean, deviation),
        "lognormal": lambda mean, deviation: ot.LogNormalMuSigma(mean, deviation, 0.0).getDistribution(),
        "triangular": lambda a, mode, b: ot.Triangular(a, mode, b),
        "weibull": lambda scale, shape, start: ot.WeibullMin(scale, shape, start),
    }
    try:
        found = laws[law](*parameters)
    except (TypeError, RuntimeError) as error:
        raise WrongInput(f'variable "{name}": {law} with {parameters} is refused by OpenTURNS: {str(error).strip()}')
    if not truncated:
        return found
    low, high = found.getRange().getLowerBound()[0], found.getRange().getUpperBound()[0]
    if truncated[1] <= low or truncated[0] >= high:
        raise WrongInput(f'variable "{name}": truncated = {truncated} leaves nothing of its distribution, which lies between {low:.6g} and {high:.6g}; give other bounds')
    return ot.TruncatedDistribution(found, *truncated)


def values_of(variable, u):
    """Quantiles of a variable at probabilities u; of levels their numbers."""
    u = np.clip(u, SMALLEST, 1.0 - SMALLEST)
    if "levels" in variable:
        edges = np.cumsum(variable["levels"])
        return np.minimum(np.searchsorted(edges, u * edges[-1], side="right"), len(edges) - 1).astype(float)
    law, parameters = variable["law"], variable["parameters"]
    if law == "integers":
        return parameters[0] + np.floor(u * (parameters[1] - parameters[0] + 1.0))
    if law == "measured":
        values = np.sort(np.array(parameters))
        return values[np.floor(u * len(values)).astype(int)]
    return np.array(distribution(variable["name"], law, parameters, variable.get("truncated")).computeQuantile(u.tolist()))[:, 0]


def draw(request, folder):
    variables, blocks = request["variables"], []
    for block in range(request["blocks"]):
        points = uniforms(request["design"], request["count"], len(variables), request["seed"], block)
        points = correlated(points, request["correlations"])
        blocks.append(np.column_stack([values_of(v, points[:, j]) for j, v in enumerate(variables)] or [np.zeros((len(points), 0))]))
    values = np.vstack(blocks)
    values.astype("<f8").tofile(folder / "values.bin")
    return {"rows": values.shape[0], "columns": values.shape[1]}


# statistics -----------------------------------------------------------------------------------------------------------


def quantile_interval(values, probability, confidence):
    """Value and interval of a quantile from order statistics: distribution-free, for independent draws (Wilks).

    The bounds are x_(l) and x_(u) with P(B <= l - 1) < a/2, P(B >= u) <= a/2 for B binomial (n, p), a = 1 - confidence; None: n too small for one."""
    values = np.sort(values)
    count, tail = len(values), 0.5 * (1.0 - confidence)
    if count == 0:
        return None, None, None
    binomial = ot.Binomial(count, probability)
    low, high = int(binomial.computeQuantile(tail)[0]), int(binomial.computeQuantile(1.0 - tail)[0]) + 1
    value = values[min(count - 1, max(0, math.ceil(count * probability) - 1))]
    return value, values[low - 1] if low >= 1 else None, values[high - 1] if high <= count else None


def share_interval(hits, count, confidence):
    """Of a probability, Clopper and Pearson's."""
    tail = 0.5 * (1.0 - confidence)
    low = ot.Beta(hits, count - hits + 1, 0.0, 1.0).computeQuantile(tail)[0] if hits > 0 else 0.0
    high = ot.Beta(hits + 1, count - hits, 0.0, 1.0).computeQuantile(1.0 - tail)[0] if hits < count else 1.0
    return low, high


def rank_correlation(x, y, confidence):
    """Spearman's, with the interval of Fisher's transform and the variance (1 + r^2/2)/(n - 3) (Bonett and Wright 2000)."""
    if len(x) < 4 or np.ptp(x) == 0.0 or np.ptp(y) == 0.0:
        return None
    sample = [np.asarray(column).reshape(-1, 1) for column in (x, y)]
    r = ot.CorrelationAnalysis(*map(ot.Sample, sample)).computeSpearmanCorrelation()[0]
    if len(x) <= 4 or abs(r) >= 1.0:
        return {"value": r, "low": None, "high": None}
    width = ot.Normal().computeQuantile(0.5 + 0.5 * confidence)[0] * math.sqrt((1.0 + 0.5 * r * r) / (len(x) - 3.0))
    return {"value": r, "low": math.tanh(math.atanh(r) - width), "high": math.tanh(math.atanh(r) + width)}


def sobol_indices(inputs, outputs, count, names, confidence):
    """First-order and total indices by Martinez's estimator with its asymptotic intervals; None where a case is missing or nothing varies."""
    if not names or len(outputs) != count * (len(names) + 2) or not np.isfinite(outputs).all() or np.ptp(outputs) == 0.0:
        return None
    algorithm = ot.MartinezSensitivityAlgorithm(ot.Sample(inputs), ot.Sample(outputs.reshape(-1, 1)), count)
    algorithm.setUseAsymptoticDistribution(True)
    algorithm.setConfidenceLevel(confidence)
    out = {}
    first, total = algorithm.getFirstOrderIndices(), algorithm.getTotalOrderIndices()
    intervals = algorithm.getFirstOrderIndicesInterval(), algorithm.getTotalOrderIndicesInterval()
    for i, name in enumerate(names):
        out[name] = {"value": first[i], "low": intervals[0].getLowerBound()[i], "high": intervals[0].getUpperBound()[i],
                     "total": total[i], "total_low": intervals[1].getLowerBound()[i], "total_high": intervals[1].getUpperBound()[i]}  # fmt: skip
    return out


def finite_or_none(value, infinite):
    """JSON has no infinity: it is the text `infinite`."""
    if value is None or math.isnan(value):
        return None
    return float(value) if math.isfinite(value) else infinite


def of_output(name, values, errors, request):
    infinite = "worn away" if name.endswith(".wear_depth") else "never"  # a depth beyond its geometry; a life
    present = values[~np.isnan(values)]
    finite = present[np.isfinite(present)]
    out = {"cases": len(present), "quantiles": []}
    for key, figure in (("mean", np.mean), ("minimum", np.min), ("maximum", np.max)):
        out[key] = float(figure(finite)) if len(finite) else None
    out["deviation"] = float(np.std(finite, ddof=1)) if len(finite) > 1 else None
    if errors is not None and len(finite) > 1 and out["deviation"] > 0.0:
        known = errors[np.isfinite(errors)]
        out["share_of_windows"] = float(np.mean(known**2) / out["deviation"] ** 2) if len(known) else None
    for probability in request["quantiles"]:
        found = quantile_interval(present, probability, request["confidence"])
        out["quantiles"].append(dict(zip(("probability", "value", "low", "high"), (probability, *(finite_or_none(x, infinite) for x in found)))))
    return out


def of_limit(limit, values, confidence):
    present = values[~np.isnan(values)]
    hits = int(np.sum(present > limit["value"] if limit["above"] else present < limit["value"]))
    out = {**limit, "cases": len(present), "hits": hits}
    if len(present):
        out["probability"] = hits / len(present)
        out["low"], out["high"] = share_interval(hits, len(present), confidence)
    return out


BODIES = {".support_years": "support", ".years": "tube"}  # of outputs of lives, the longer ending first


def first_supports(lives, values, confidence, present=None):
    """Shares of the cases by what reaches its limit first, the largest first. lives: names of the columns of values, a; NaN: no value.

    present: where the support is in the case; default: where it has a value. A case with a support that has no value is not judged. It is in the upper
    end of the share of what may be first in it: these supports, and the first of the others."""
    known = ~np.isnan(values)
    unknown = (np.zeros_like(known) if present is None else present) & ~known
    there = (known | unknown).any(axis=1)
    unknown, values = unknown[there], np.where(known, values, math.inf)[there]
    judged = ~unknown.any(axis=1)
    first = np.where(np.isfinite(values.min(axis=1)), values.argmin(axis=1), -1) if len(values) else np.zeros(0, int)
    supports, without = [], []
    for number, name in enumerate(lives):
        ending = next(ending for ending in BODIES if name.endswith(ending))
        life = {"support": name[: -len(ending)], "body": BODIES[ending]}
        hits, possible = int(np.sum(judged & (first == number))), int(np.sum(unknown[:, number] | (first == number)))
        if hits:
            low, high = share_interval(hits, len(first), confidence)[0], share_interval(possible, len(first), confidence)[1]
            supports.append({**life, "hits": hits, "share": hits / len(first), "low": low, "high": high})
        if unknown[:, number].any():
            without.append({**life, "cases": int(unknown[:, number].sum())})
    return {"cases": len(first), "never": int(np.sum(judged & (first == -1))), "not_judged": int(np.sum(~judged)),
            "supports": sorted(supports, key=lambda entry: -entry["hits"]), "unknown": sorted(without, key=lambda entry: -entry["cases"])}  # fmt: skip


def convergence(values, until, confidence):
    """Half width of the interval of a quantile over its value, and how many cases would halve it as asked for."""
    present = values[~np.isnan(values)]
    value, low, high = quantile_interval(present, until["quantile"], confidence)
    out = {**until, "cases": len(present), "reached": False, "error": None, "cases_needed": None}
    if low is None or high is None:
        wilks = [int(ot.Wilks.ComputeSampleSize(p, 0.5 + 0.5 * confidence, 0)) for p in (until["quantile"], 1.0 - until["quantile"])]
        out["cases_needed"] = max(wilks)
        return out
    if math.isfinite(high) and value != 0.0:
        out["error"] = abs(0.5 * (high - low) / value)
        out["reached"] = bool(out["error"] <= until["relative_error"])
        out["cases_needed"] = math.ceil(len(present) * (out["error"] / until["relative_error"]) ** 2)
    return out


def summarize(request, folder):
    rows, names = request["rows"], request["outputs"]
    data = np.fromfile(folder / "values.bin", "<f8").reshape(rows, -1)
    inputs, outputs = data[:, : len(request["inputs"])], data[:, len(request["inputs"]) :]
    column = {name: outputs[:, j] for j, name in enumerate(names)}
    saltelli = request["design"] == "saltelli"
    independent = 2 * request["count"] if saltelli else rows  # the other points are made of the coordinates of these
    answer = {"outputs": {}, "limits": [], "sensitivities": {}, "method": "sobol" if saltelli else "spearman"}
    for name in names:
        if name.endswith(".error"):
            continue
        errors = column.get(name + ".error")
        answer["outputs"][name] = of_output(name, column[name][:independent], None if errors is None else errors[:independent], request)
        if saltelli:
            found = sobol_indices(inputs, column[name], request["count"], request["inputs"], request["confidence"])
        else:
            known = np.isfinite(column[name])
            found = {v: rank_correlation(inputs[known, i], column[name][known], request["confidence"]) for i, v in enumerate(request["inputs"])}
            found = {v: value for v, value in found.items() if value}
        if found:
            answer["sensitivities"][name] = found
    answer["limits"] = [of_limit(limit, column[limit["output"]][:independent], request["confidence"]) for limit in request["limits"]]
    lives = request["lives"]
    if len(lives) > 1:
        values = np.column_stack([column[life["output"]][:independent] for life in lives])
        present = np.column_stack([np.any([~np.isnan(column[of][:independent]) for of in life["contacts"]], axis=0) for life in lives])
        answer["first_support"] = first_supports([life["output"] for life in lives], values, request["confidence"], present)
    answer["convergence"] = convergence(column[request["until"]["output"]][:independent], request["until"], request["confidence"])
    return answer


def main(folder):
    request = json.loads((folder / "request.json").read_text())
    operations = {"draw": draw, "summarize": summarize}
    try:
        answer = operations[request["operation"]](request, folder)
    except (WrongInput, TypeError, RuntimeError) as error:  # OpenTURNS's exceptions are these
        print(error)
        return 1
    (folder / "answer.json").write_text(json.dumps(answer, allow_nan=False))
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
