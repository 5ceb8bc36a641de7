// The 3-D right-hand side of benchmarks/pair_functions.py as one hand-written C++ loop on the same
// neighbor list and the same arrays; built by test_pair_loop.py with g++ -O3 -march=native -fopenmp.
#include <cmath>
#include <cstdint>

extern "C" void right_hand_side(
    std::int64_t count, const std::uint64_t *__restrict row_start,
    const std::uint32_t *__restrict neighbor, std::int64_t stride, const double *__restrict x,
    const double *__restrict l, const double *__restrict v, const double *__restrict rho,
    const double *__restrict p, const double *__restrict m, double mu,
    double *__restrict acceleration, double *__restrict density_rate, double sigma, int threads) {
  const double *x0 = x, *x1 = x + stride, *x2 = x + 2 * stride;
  const double *v0 = v, *v1 = v + stride, *v2 = v + 2 * stride;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i) {
    const double xi0 = x0[i], xi1 = x1[i], xi2 = x2[i];
    const double vi0 = v0[i], vi1 = v1[i], vi2 = v2[i];
    const double li = l[i], rho_i = rho[i];
    const double pressure_i = p[i] / (rho_i * rho_i);
    double a0 = 0.0, a1 = 0.0, a2 = 0.0, rate = 0.0;
    const std::uint64_t last = row_start[i + 1];
    for (std::uint64_t q = row_start[i]; q < last; ++q) {
      const std::uint64_t j = neighbor[q];
      const double d0 = xi0 - x0[j], d1 = xi1 - x1[j], d2 = xi2 - x2[j];
      const double r = std::sqrt(d0 * d0 + d1 * d1 + d2 * d2);
      const double u = 1.0 / (0.5 * (li + l[j]));
      const double s = r * u, t = 1.0 - s;
      const double slope = -20.0 * s * (t * t * t);
      const double factor = sigma * (u * u) * (u * u) * slope / r;
      const double rho_j = rho[j], m_j = m[j];
      const double w0 = vi0 - v0[j], w1 = vi1 - v1[j], w2 = vi2 - v2[j];
      const double pressure = m_j * factor * (pressure_i + p[j] / (rho_j * rho_j));
      const double viscous = m_j * factor * 2.0 * mu / (rho_i * rho_j);
      a0 += viscous * w0 - pressure * d0;
      a1 += viscous * w1 - pressure * d1;
      a2 += viscous * w2 - pressure * d2;
      rate += m_j * factor * (w0 * d0 + w1 * d1 + w2 * d2);
    }
    acceleration[i] = a0;
    acceleration[i + stride] = a1;
    acceleration[i + 2 * stride] = a2;
    density_rate[i] = rate;
  }
}
