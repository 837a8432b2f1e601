// Worst-case relative manipulability of a 9-joint arm by hand: what a C++ programmer would write, as the upper mark.
//
//   g++ -O3 -march=native -ffast-math -fopenmp -shared -fPIC rho_simd.cpp
//
// Eight configurations at once, one per SIMD lane. Full 6 x 9 Jacobian at the tool in the base frame, Cholesky factor L of
// J J', leverage |L^-1 j_k|^2 of every column, and rho = sqrt(1 - largest leverage).
#include <cmath>
#include <cstddef>

namespace {

constexpr int kJoints = 9;
constexpr int kLanes = 8;
typedef double Pack __attribute__((vector_size(kLanes * sizeof(double))));

struct Vec3 {
  Pack x, y, z;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Pack s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

inline Pack root(Pack a) {
  for (int lane = 0; lane < kLanes; ++lane) a[lane] = std::sqrt(a[lane]);
  return a;
}

inline Pack larger(Pack a, Pack b) { return a > b ? a : b; }

struct Arm {
  const double *a, *d, *cos_alpha, *sin_alpha;  // standard Denavit-Hartenberg table
};

inline void jacobian(const Pack *cosine, const Pack *sine, const Arm &arm, Pack j[kJoints][6]) {
  const Pack zero = {};
  Vec3 x{zero + 1, zero, zero}, y{zero, zero + 1, zero}, z{zero, zero, zero + 1}, p{zero, zero, zero};
  Vec3 axis[kJoints], origin[kJoints];
  for (int i = 0; i < kJoints; ++i) {
    axis[i] = z;
    origin[i] = p;
    const Vec3 turned = cosine[i] * x + sine[i] * y;
    const Vec3 side = cosine[i] * y - sine[i] * x;
    p = p + arm.d[i] * z + arm.a[i] * turned;
    y = arm.cos_alpha[i] * side + arm.sin_alpha[i] * z;
    z = arm.cos_alpha[i] * z - arm.sin_alpha[i] * side;
    x = turned;
  }
  for (int i = 0; i < kJoints; ++i) {
    const Vec3 v = cross(axis[i], p - origin[i]);
    j[i][0] = v.x, j[i][1] = v.y, j[i][2] = v.z;
    j[i][3] = axis[i].x, j[i][4] = axis[i].y, j[i][5] = axis[i].z;
  }
}

inline Pack largest_leverage(const Pack j[kJoints][6]) {
  Pack l[6][6], inverse[6];
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) {
      Pack sum = j[0][row] * j[0][column];
      for (int k = 1; k < kJoints; ++k) sum += j[k][row] * j[k][column];
      for (int i = 0; i < column; ++i) sum -= l[row][i] * l[column][i];
      if (row == column) {
        inverse[row] = 1.0 / root(sum);
      } else {
        l[row][column] = sum * inverse[column];
      }
    }
  }
  Pack largest = {};
  for (int k = 0; k < kJoints; ++k) {
    Pack y[6], leverage = {};
    for (int row = 0; row < 6; ++row) {
      Pack rest = j[k][row];
      for (int i = 0; i < row; ++i) rest -= l[row][i] * y[i];
      y[row] = rest * inverse[row];
      leverage += y[row] * y[row];
    }
    largest = larger(leverage, largest);
  }
  return largest;
}

}  // namespace

// q (count, 9) row-major in, out (count) filled; a last incomplete pack repeats its last row.
extern "C" void worst_relative_manipulability(const double *q, double *out, std::size_t count, const double *a,
                                              const double *d, const double *cos_alpha, const double *sin_alpha,
                                              int threads) {
  const Arm arm{a, d, cos_alpha, sin_alpha};
  const std::size_t packs = (count + kLanes - 1) / kLanes;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t pack = 0; pack < packs; ++pack) {
    const std::size_t start = pack * kLanes;
    alignas(64) double angle[kJoints * kLanes], c[kJoints * kLanes], s[kJoints * kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::size_t row = start + lane < count ? start + lane : count - 1;
      for (int i = 0; i < kJoints; ++i) angle[i * kLanes + lane] = q[row * kJoints + i];
    }
    // Two plain loops over arrays: g++ calls the vector versions of the C library for them.
    for (int i = 0; i < kJoints * kLanes; ++i) c[i] = std::cos(angle[i]);
    for (int i = 0; i < kJoints * kLanes; ++i) s[i] = std::sin(angle[i]);
    Pack j[kJoints][6];
    jacobian(reinterpret_cast<const Pack *>(c), reinterpret_cast<const Pack *>(s), arm, j);
    const Pack left = 1.0 - largest_leverage(j);
    const Pack rho = root(larger(left, Pack{}));
    for (int lane = 0; lane < kLanes && start + lane < count; ++lane) out[start + lane] = rho[lane];
  }
}
