// SPDX-License-Identifier: Apache-2.0
// What `telehug-active eval` computes of errors (active_side/eval/error_statistics.hpp), for the same words to mean the
// same here and there. All want at least one value.
export const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

// Of a sample; 0 for a single value.
export function standardDeviation(values) {
  if (values.length < 2) return 0;
  const middle = mean(values);
  return Math.sqrt(values.reduce((sum, value) => sum + (value - middle) ** 2, 0) / (values.length - 1));
}

const rising = (values) => [...values].sort((a, b) => a - b);

// Interpolated between two values: definition 7 of Hyndman and Fan, "Sample Quantiles in Statistical Packages", The
// American Statistician 50 (1996), 361-365; share from 0 to 1.
export function quantile(values, share) {
  const sorted = rising(values);
  const rank = share * (sorted.length - 1);
  const below = Math.floor(rank);
  const above = Math.min(below + 1, sorted.length - 1);
  return sorted[below] + (rank - below) * (sorted[above] - sorted[below]);
}

export const median = (values) => quantile(values, 0.5);

// The smallest value that at least this share of all does not exceed: definition 1 there. So it is one of the values.
export function reachedBy(values, share) {
  return rising(values)[Math.max(1, Math.ceil(share * values.length)) - 1];
}

// Quartiles as above; whiskers as Tukey has them ("Exploratory Data Analysis", 1977): to the outermost values within 1.5
// times the box' length from the box. What lies beyond is an outlier.
export function boxPlot(values) {
  const sorted = rising(values);
  const [first, middle, third] = [0.25, 0.5, 0.75].map((share) => quantile(sorted, share));
  const reach = 1.5 * (third - first);
  const isNear = (value) => value >= first - reach && value <= third + reach;
  const near = sorted.filter(isNear);
  return {low: Math.min(first, ...near), first, median: middle, third, high: Math.max(third, ...near),
          outliers: sorted.filter((value) => !isNear(value))};
}
