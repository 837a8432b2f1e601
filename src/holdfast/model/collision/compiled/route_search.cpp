// Collision checks and proofs of straight edges in joint space, the search for a route made of them, and proofs of spans of motions.
//
// tools/native.py compiles this file to route_search.ll, which LLVM translates for the processor on first use.
// There is no standard library, no allocation, and no state. One function serves every arm, cell, and set of locked joints,
// because all of them are tables (see scene.py, which contains the same structures).
//
// Edges are checked at many configurations at once: a value of type Lanes<T>::V holds one number of each configuration. Checks
// use single precision. Proofs of edges use double precision, and no edge counts as valid before its proof. Proofs of spans use
// single precision and an allowance for its rounding.
//
// Sources: RRT-Connect (Kuffner and LaValle 2000); configurations of an edge in interleaved order and many at once (Thomason,
// Kingston and Kavraki 2024); segments (Ericson 2005, section 5.1.9); splitmix64 (Steele, Lea and Flood 2014).

typedef long long Int;
typedef unsigned long long Bits;

constexpr Int MAX_JOINTS = 16;  // joints of an arm: one row of floats is one register
constexpr Int MAX_LINKS = MAX_JOINTS + 1;
constexpr Int MAX_LINK_PAIRS = MAX_LINKS * (MAX_LINKS - 1) / 2;
constexpr Int MAX_PARTS = 192;  // capsules of an arm
constexpr Int MAX_POINTS = 256;  // waypoints of a route
constexpr Int MAX_PIECES = 4096;  // pieces of an edge that wait for their proof
constexpr Int MAX_COMPARED = 64;  // possible contacts that a new one may continue
constexpr float UNCHECKED_M = -1e8f;  // allowance of a link and an object that may touch

template <class T> struct Lanes;
template <> struct Lanes<float> {
  static constexpr Int COUNT = 16;
  typedef float V __attribute__((vector_size(64)));
  typedef int Mask __attribute__((vector_size(64)));
};
template <> struct Lanes<double> {
  static constexpr Int COUNT = 8;
  typedef double V __attribute__((vector_size(64)));
  typedef long long Mask __attribute__((vector_size(64)));
};
typedef Lanes<float>::V Row;  // joint values of one configuration
typedef float StoredRow __attribute__((vector_size(64), aligned(4)));  // the same in an array of the caller

#define INLINE static inline __attribute__((always_inline))

template <class V> INLINE V square_root(V x) { return __builtin_elementwise_sqrt(x); }
template <class V> INLINE V larger(V a, V b) { return a > b ? a : b; }
template <class V> INLINE V smaller(V a, V b) { return a < b ? a : b; }
typedef bool Bits16 __attribute__((ext_vector_type(16)));
typedef bool Bits8 __attribute__((ext_vector_type(8)));
INLINE unsigned bits_of(Lanes<float>::Mask mask) {
  return __builtin_bit_cast(unsigned short, __builtin_convertvector(mask, Bits16));
}
INLINE unsigned bits_of(Lanes<double>::Mask mask) {
  return __builtin_bit_cast(unsigned char, __builtin_convertvector(mask, Bits8));
}
template <class M> INLINE bool any(M mask) { return bits_of(mask) != 0; }
INLINE bool all(Lanes<float>::Mask mask) { return bits_of(mask) == 0xffff; }
INLINE bool all(Lanes<double>::Mask mask) { return bits_of(mask) == 0xff; }

INLINE float sum_of(Row a) {
  typedef float Half __attribute__((vector_size(32)));
  typedef float Quarter __attribute__((vector_size(16)));
  Half half = __builtin_shufflevector(a, a, 0, 1, 2, 3, 4, 5, 6, 7) + __builtin_shufflevector(a, a, 8, 9, 10, 11, 12, 13, 14, 15);
  Quarter quarter = __builtin_shufflevector(half, half, 0, 1, 2, 3) + __builtin_shufflevector(half, half, 4, 5, 6, 7);
  return (quarter[0] + quarter[2]) + (quarter[1] + quarter[3]);
}

// ---- tables (the structures of scene.py) ------------------------------------------------------------------------------------

template <class T> struct Sphere { T x, y, z, radius; };
template <class T> struct Joint { T rotation[9], position[3], is_prismatic; };  // from the previous link; the axis is z
template <class T> struct Object { T rotation[9], position[3], half_size[3], rounding, is_round, is_open; };
template <class T> struct Part { T center[3], span[3], radius, reach; };  // a capsule of a link; the reach is that of its center
struct LinkPair { Int first_link, second_link, first_pair, end_pair; };
struct PartPair { Int first, second; };

template <class T> struct Scene {
  Int joint_count, object_count, link_pair_count;
  const Joint<T> *joints;
  const Int *first_sphere;     // (links + 1) of the spheres of each link, which are checked against objects; link 0 is the world
  const Sphere<T> *spheres;
  const Sphere<T> *enclosing;  // (links) around the spheres of a link; radius below 0: none
  const Object<T> *objects;
  const T *allowances;         // (links, objects) required distance
  const Part<T> *parts;
  const Int *first_part;       // (links + 1) of the parts of each link
  const Sphere<T> *part_enclosing;  // (links) around the parts of a link
  const LinkPair *link_pairs;
  const PartPair *pairs;
  const T *link_bounds;        // (links, joints) motion of the spheres of a link per unit of each joint
  const T *pair_bounds;        // (link pairs, joints) change of the distance of two links
  const T *pair_allowances;    // (link pairs) required distance
};

struct Problem {
  const float *low, *high;   // (16) box of samples; equal for joints that do not move
  const float *scale;        // (16) scale of each joint in lengths; 0 for joints that do not move
  const float *revolution;   // (16) 2 pi for joints without limits, else 0
  Int has_largest_joint_metric;  // length is the largest scaled joint motion instead of the Euclidean norm
  Int max_nodes, max_rounds, max_shortcut_failures;
  StoredRow *nodes;          // (2, max_nodes)
  int *parents;              // (2, max_nodes)
  float largest_step;        // length of one step of a tree
  float sample_spacing;      // motion in m between the configurations of an edge that are checked
  float room;                // distance in m in addition to what is required
};

// ---- kinematics -------------------------------------------------------------------------------------------------------------

INLINE void sine_and_cosine(Lanes<float>::V x, Lanes<float>::V &sine, Lanes<float>::V &cosine) {
  typedef Lanes<float>::V V;
  V turns = (x * 0.31830988618f + 12582912.0f) - 12582912.0f;  // multiples of pi
  V y = ((x - turns * 3.140625f) - turns * 9.67502593994140625e-4f) - turns * 1.509957990978376432e-7f;
  V half = turns * 0.5f;
  V sign = 1.0f - 4.0f * __builtin_elementwise_abs(half - ((half + 12582912.0f) - 12582912.0f));
  V z = y * y;
  sine = sign * (y + y * z * (-1.6666654611e-1f + z * (8.3321608736e-3f + z * (-1.9515295891e-4f + z * 2.6e-6f))));
  cosine = sign * (1.0f - 0.5f * z + z * z * (4.166664568e-2f + z * (-1.388731625e-3f + z * (2.443315711e-5f - z * 2.6e-7f))));
}

INLINE void sine_and_cosine(Lanes<double>::V x, Lanes<double>::V &sine, Lanes<double>::V &cosine) {
  typedef Lanes<double>::V V;
  V turns = (x * 0.318309886183790671538 + 6755399441055744.0) - 6755399441055744.0;
  V y = ((x - turns * 3.14159265346825122833) - turns * 1.21542010126079319e-10) - turns * 4.04453249777230189e-21;
  V half = turns * 0.5;
  V sign = 1.0 - 4.0 * __builtin_elementwise_abs(half - ((half + 6755399441055744.0) - 6755399441055744.0));
  V h = y * 0.5, z = h * h;  // polynomials of fdlibm at half the angle
  V s = h + h * z * (-1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 +
        z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  V c = 1.0 - 0.5 * z + z * z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 +
        z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11)))));
  sine = sign * 2.0 * s * c;
  cosine = sign * (1.0 - 2.0 * s * s);
}

template <class V> struct Point { V x, y, z; };

template <class T> struct Frame {
  typedef typename Lanes<T>::V V;
  V r[9], p[3];  // rotation by rows, and position, in the world

  __attribute__((always_inline)) Point<V> transform(T x, T y, T z) const {
    return {p[0] + r[0] * x + r[1] * y + r[2] * z, p[1] + r[3] * x + r[4] * y + r[5] * z, p[2] + r[6] * x + r[7] * y + r[8] * z};
  }
  __attribute__((always_inline)) Point<V> rotate(const T *v) const {
    return {r[0] * v[0] + r[1] * v[1] + r[2] * v[2], r[3] * v[0] + r[4] * v[1] + r[5] * v[2], r[6] * v[0] + r[7] * v[1] + r[8] * v[2]};
  }
};

// Frames of all links, the fixed base in the world first, at configurations.
template <class T> INLINE void compute_frames(Int joint_count, const Joint<T> *joints, const typename Lanes<T>::V *configurations,
                                              Frame<T> *frames) {
  typedef typename Lanes<T>::V V;
  const V zero = {};
  for (Int k = 0; k < 9; k++) frames[0].r[k] = zero + T(k % 4 == 0);
  for (Int k = 0; k < 3; k++) frames[0].p[k] = zero;
  for (Int j = 0; j < joint_count; j++) {
    const Joint<T> &joint = joints[j];
    const Frame<T> &before = frames[j];
    Frame<T> &after = frames[j + 1];
    const V q = configurations[j];
    Point<V> p = before.transform(joint.position[0], joint.position[1], joint.position[2]);
    V r[9];
    for (Int row = 0; row < 3; row++)
      for (Int column = 0; column < 3; column++)
        r[3 * row + column] = before.r[3 * row] * joint.rotation[column] + before.r[3 * row + 1] * joint.rotation[3 + column] +
                              before.r[3 * row + 2] * joint.rotation[6 + column];
    after.p[0] = p.x, after.p[1] = p.y, after.p[2] = p.z;
    if (joint.is_prismatic != 0) {
      for (Int k = 0; k < 9; k++) after.r[k] = r[k];
      for (Int k = 0; k < 3; k++) after.p[k] += r[3 * k + 2] * q;
      continue;
    }
    V s, c;
    sine_and_cosine(q, s, c);
    for (Int row = 0; row < 3; row++) {
      after.r[3 * row] = r[3 * row] * c + r[3 * row + 1] * s;
      after.r[3 * row + 1] = r[3 * row + 1] * c - r[3 * row] * s;
      after.r[3 * row + 2] = r[3 * row + 2];
    }
  }
}

// ---- distances --------------------------------------------------------------------------------------------------------------

// Square of the distance of a point from an object without its rounding; 0 inside.
template <class T> INLINE typename Lanes<T>::V squared_distance(const Object<T> &o, const Point<typename Lanes<T>::V> &point) {
  typedef typename Lanes<T>::V V;
  V x = o.position[0] + o.rotation[0] * point.x + o.rotation[1] * point.y + o.rotation[2] * point.z;
  V y = o.position[1] + o.rotation[3] * point.x + o.rotation[4] * point.y + o.rotation[5] * point.z;
  V z = o.position[2] + o.rotation[6] * point.x + o.rotation[7] * point.y + o.rotation[8] * point.z;
  const V zero = x * T(0);
  V along = o.is_open != 0 ? z : __builtin_elementwise_abs(z);
  V across = o.is_round != 0 ? square_root(x * x + y * y) : __builtin_elementwise_abs(x);
  V beyond_x = larger(across - o.half_size[0], zero), beyond_z = larger(along - o.half_size[2], zero);
  V square = beyond_x * beyond_x + beyond_z * beyond_z;
  if (o.is_round != 0) return square;
  V beyond_y = larger(__builtin_elementwise_abs(y) - o.half_size[1], zero);
  return square + beyond_y * beyond_y;
}

template <class V> INLINE V squared_gap(const Point<V> &a, const Point<V> &b) {
  V x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

template <class V> INLINE V dot(const Point<V> &a, const Point<V> &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Square of the distance of the axes of two capsules, whose centers are ``p`` and ``q``.
template <class T, class P>
INLINE typename Lanes<T>::V squared_distance(const Frame<T> &f, const Part<T> &a, const P &p, const Frame<T> &g, const Part<T> &b,
                                             const P &q) {
  typedef typename Lanes<T>::V V;
  const T aa = a.span[0] * a.span[0] + a.span[1] * a.span[1] + a.span[2] * a.span[2];
  const T bb = b.span[0] * b.span[0] + b.span[1] * b.span[1] + b.span[2] * b.span[2];
  if (aa == 0 && bb == 0) return squared_gap(p, q);
  const V half = p.x * T(0) + T(0.5);
  Point<V> u = f.rotate(a.span), v = g.rotate(b.span), gap = {p.x - q.x, p.y - q.y, p.z - q.z};
  const T inverse_aa = aa > 0 ? 1 / aa : 0, inverse_bb = bb > 0 ? 1 / bb : 0;
  V ab = dot(u, v), a_gap = dot(u, gap), b_gap = dot(v, gap);
  V determinant = aa * bb - ab * ab;
  auto is_skew = determinant > T(1e-7) * aa * bb;
  V s = (ab * b_gap - bb * a_gap) / (is_skew ? determinant : half);
  s = is_skew ? smaller(larger(s, -half), half) : -half;
  V t = smaller(larger((ab * s + b_gap) * inverse_bb, -half), half);
  s = smaller(larger((ab * t - a_gap) * inverse_aa, -half), half);
  t = smaller(larger((ab * s + b_gap) * inverse_bb, -half), half);
  Point<V> foot = {gap.x + u.x * s - v.x * t, gap.y + u.y * s - v.y * t, gap.z + u.z * s - v.z * t};
  return dot(foot, foot);
}

// Bounds of the motion of every link, and of the distance between links, along an edge and by deviations from it, m.
template <class T> struct Motion { T link[MAX_LINKS], link_deviation[MAX_LINKS], pair[MAX_LINK_PAIRS], pair_deviation[MAX_LINK_PAIRS]; };

template <class T> INLINE T weighted_sum(Int count, const T *bounds, const T *values) {
  T total = 0;
  for (Int j = 0; j < count; j++) total += bounds[j] * (values[j] < 0 ? -values[j] : values[j]);
  return total;
}

// Bound the motion of every link, and the change of the distance of every pair of links, for ``values`` of the joints' motions.
template <class T> static void bound_motion(const Scene<T> &scene, const T *values, T *links, T *pairs) {
  const Int n = scene.joint_count;
  for (Int link = 0; link <= n; link++) links[link] = weighted_sum(n, scene.link_bounds + link * n, values);
  for (Int k = 0; k < scene.link_pair_count; k++) pairs[k] = weighted_sum(n, scene.pair_bounds + k * n, values);
}

template <class T> static T find_largest_motion(const Scene<T> &scene, const Motion<T> &motion) {
  T largest = 0;
  for (Int link = 0; link <= scene.joint_count; link++)
    if (motion.link[link] > largest) largest = motion.link[link];
  for (Int k = 0; k < scene.link_pair_count; k++)
    if (motion.pair[k] > largest) largest = motion.pair[k];
  return largest;
}

// Configurations in which a link may be closer to an object, or to another link, than required, after motions of so many m.
// With ``stop_at_first`` the result only tells any from none. ``report`` is called with every pair that is too close, links and
// objects first, then capsules; and with its links.
template <class T, bool stop_at_first, bool reports_all, class Report>
INLINE typename Lanes<T>::Mask find_too_close(const Scene<T> &scene, const Frame<T> *frames, const typename Lanes<T>::V *link_motions,
                                              const typename Lanes<T>::V *pair_motions, Report report) {
  typedef typename Lanes<T>::V V;
  const V none = {};
  typename Lanes<T>::Mask too_close = none < none;
  for (Int link = 1; link <= scene.joint_count; link++) {
    const Sphere<T> &around = scene.enclosing[link];
    if (around.radius < 0) continue;
    const Frame<T> &frame = frames[link];
    Point<V> center = frame.transform(around.x, around.y, around.z);
    const V needed = link_motions[link];
    for (Int k = 0; k < scene.object_count; k++) {
      const Object<T> &object = scene.objects[k];
      const T allowance = scene.allowances[link * scene.object_count + k] + object.rounding;
      if (allowance < UNCHECKED_M) continue;
      V reach = larger(needed + (allowance + around.radius), none);
      if (!any(squared_distance(object, center) < reach * reach)) continue;
      typename Lanes<T>::Mask near = none < none;
      for (Int sphere = scene.first_sphere[link]; sphere < scene.first_sphere[link + 1]; sphere++) {
        const Sphere<T> &ball = scene.spheres[sphere];
        V limit = larger(needed + (allowance + ball.radius), none);
        near |= squared_distance(object, frame.transform(ball.x, ball.y, ball.z)) < limit * limit;
        if (stop_at_first && any(near)) return near;
      }
      too_close |= near;
      if (!reports_all && all(too_close)) return too_close;
      report((link - 1) * scene.object_count + k, near, 0, link);
    }
  }
  Point<V> centers[MAX_PARTS];  // of the parts of the links in ``placed``
  Bits placed = 0;
  for (Int k = 0; k < scene.link_pair_count; k++) {
    const LinkPair &links = scene.link_pairs[k];
    const Sphere<T> &a = scene.part_enclosing[links.first_link], &b = scene.part_enclosing[links.second_link];
    const Frame<T> &f = frames[links.first_link], &g = frames[links.second_link];
    const V needed = pair_motions[k] + scene.pair_allowances[k];
    const Point<V> second_center = g.transform(b.x, b.y, b.z);
    V reach = larger(needed + (a.radius + b.radius), none);
    if (!any(squared_gap(f.transform(a.x, a.y, a.z), second_center) < reach * reach)) continue;
    const Int both_links[2] = {links.first_link, links.second_link};
    for (Int link : both_links) {
      if (placed >> link & 1) continue;
      placed |= Bits(1) << link;
      for (Int part = scene.first_part[link]; part < scene.first_part[link + 1]; part++) {
        const T *center = scene.parts[part].center;
        centers[part] = frames[link].transform(center[0], center[1], center[2]);
      }
    }
    Int tested = -1;
    bool is_near = false;  // the tested part may be close to the second link
    for (Int pair = links.first_pair; pair < links.end_pair; pair++) {
      const PartPair &parts = scene.pairs[pair];
      const Part<T> &first = scene.parts[parts.first], &second = scene.parts[parts.second];
      if (parts.first != tested) {
        tested = parts.first;
        reach = larger(needed + (first.reach + b.radius), none);
        is_near = any(squared_gap(centers[tested], second_center) < reach * reach);
      }
      if (!is_near) continue;
      reach = larger(needed + (first.reach + second.reach), none);
      if (!any(squared_gap(centers[parts.first], centers[parts.second]) < reach * reach)) continue;
      const V limit = larger(needed + (first.radius + second.radius), none);
      const auto near = squared_distance(f, first, centers[parts.first], g, second, centers[parts.second]) < limit * limit;
      too_close |= near;
      if (stop_at_first && any(near)) return near;
      report(scene.joint_count * scene.object_count + pair, near, links.first_link, links.second_link);
    }
  }
  return too_close;
}

// ---- edges ------------------------------------------------------------------------------------------------------------------

// The same at the configurations start + fraction * difference, within ``half`` of the edge on either side.
template <class T, bool stop_at_first>
INLINE typename Lanes<T>::Mask find_too_close(const Scene<T> &scene, const T *start, const T *difference, const Motion<T> &motion,
                                              typename Lanes<T>::V fraction, typename Lanes<T>::V half) {
  typedef typename Lanes<T>::V V;
  V q[MAX_JOINTS], link_motions[MAX_LINKS], pair_motions[MAX_LINK_PAIRS];
  Frame<T> frames[MAX_LINKS];
  for (Int j = 0; j < scene.joint_count; j++) q[j] = start[j] + fraction * difference[j];
  compute_frames(scene.joint_count, scene.joints, q, frames);
  for (Int link = 1; link <= scene.joint_count; link++) link_motions[link] = half * motion.link[link] + motion.link_deviation[link];
  for (Int k = 0; k < scene.link_pair_count; k++) pair_motions[k] = half * motion.pair[k] + motion.pair_deviation[k];
  return find_too_close<T, stop_at_first, false>(scene, frames, link_motions, pair_motions, [](Int, typename Lanes<T>::Mask, Int, Int) {});
}

// Whether every configuration that is checked along an edge has ``room`` in addition to what is required, in m; below 0 the
// spheres may overlap by so much. The start is not checked. At most ``spacing``, in m, moves any sphere between two checked configurations.
static bool is_edge_free(const Scene<float> &scene, const float *start, const float *difference, float spacing, float room) {
  typedef Lanes<float>::V V;
  Motion<float> motion;
  bound_motion(scene, difference, motion.link, motion.pair);
  for (float &deviation : motion.link_deviation) deviation = room;
  for (float &deviation : motion.pair_deviation) deviation = room;
  const Int blocks = Int(find_largest_motion(scene, motion) / (spacing * Lanes<float>::COUNT)) + 1;
  const float step = 1.0f / float(blocks * Lanes<float>::COUNT);
  V lane;
  for (Int k = 0; k < Lanes<float>::COUNT; k++) lane[k] = float(k * blocks + 1);
  for (Int block = 0; block < blocks; block++)
    if (any(find_too_close<float, true>(scene, start, difference, motion, (lane + float(block)) * step, V{}))) return false;
  return true;
}

// Prove that no configuration within ``deviation`` of an edge is closer to an object or to itself than required. Pieces are
// halved until the distances in their middle exceed the motion of half the piece, or until that motion is below ``resolution``.
static bool prove_edge(const Scene<double> &scene, const double *start, const double *difference, const double *deviation,
                       double resolution) {
  typedef Lanes<double>::V V;
  constexpr Int COUNT = Lanes<double>::COUNT;
  Motion<double> motion;
  bound_motion(scene, difference, motion.link, motion.pair);
  bound_motion(scene, deviation, motion.link_deviation, motion.pair_deviation);
  const double largest = find_largest_motion(scene, motion);
  struct Piece { double middle, half; } waiting[MAX_PIECES];
  Int count = 0;
  for (Int k = 0; k < COUNT; k++) waiting[count++] = {(2 * double(k) + 1) / (2 * COUNT), 1.0 / (2 * COUNT)};
  while (count) {
    Piece pieces[COUNT];
    V middle, half;
    const Int used = count < COUNT ? count : COUNT;
    for (Int k = 0; k < COUNT; k++) {
      pieces[k] = waiting[count - 1 - (k < used ? k : 0)];
      middle[k] = pieces[k].middle, half[k] = pieces[k].half;
    }
    count -= used;
    Lanes<double>::Mask open = find_too_close<double, false>(scene, start, difference, motion, middle, half);
    for (Int k = 0; k < used; k++) {
      if (!open[k]) continue;
      const double quarter = pieces[k].half / 2;
      if (pieces[k].half * largest * 2 < resolution || count + 2 > MAX_PIECES) return false;
      waiting[count++] = {pieces[k].middle - quarter, quarter};
      waiting[count++] = {pieces[k].middle + quarter, quarter};
    }
  }
  return true;
}

#include "constraint_manifold.hpp"

// ---- spans of motions -------------------------------------------------------------------------------------------------------

struct SpanPiece { Int row; float begin, end; };  // from and to fractions of the duration of a span; equal for an instant
struct Contact { SpanPiece piece; Int pair; double rate; };  // that is possible; the distance changes at most at this rate, m

// States at both ends of spans by columns: joint values, then rates, and the time at ``time_row``. In between, joints follow the
// cubic polynomials through both.
struct Spans {
  const double *before, *after;
  Int stride, time_row;
  float allowance, finest;  // for single precision, m; shortest duration of a piece that is halved, s
};

typedef double Wide __attribute__((vector_size(128)));  // one number of each of 16 spans
typedef double StoredWide __attribute__((vector_size(128), aligned(8)));

// Pieces in which a link may touch an object or another link, and instants at which it is in contact for certain. Pieces of
// consecutive rows are read at once. ``fine`` becomes the pieces that are not halved, and ``report`` is that of find_too_close.
template <class Report>
INLINE Bits find_open(const Scene<float> &scene, const Spans &spans, const SpanPiece *pieces, bool are_consecutive, bool is_full,
                      Bits &fine, Report report) {
  typedef Lanes<float>::V V;
  const Int n = scene.joint_count;
  V q[MAX_JOINTS], deviation[MAX_JOINTS], speed[MAX_JOINTS], link_motions[MAX_LINKS], pair_motions[MAX_LINK_PAIRS];
  V start[MAX_JOINTS], first[MAX_JOINTS], chord[MAX_JOINTS], last[MAX_JOINTS];
  float begins[Lanes<float>::COUNT], ends[Lanes<float>::COUNT];  // in memory, because it takes long to set lanes one by one
  for (Int k = 0; k < Lanes<float>::COUNT; k++) begins[k] = pieces[k].begin, ends[k] = pieces[k].end;
  const V begin = *(const StoredRow *)begins, end = *(const StoredRow *)ends, width = end - begin;
  const auto read = [&](const double *columns, Int number) {
    const double *values = columns + number * spans.stride;
    if (are_consecutive) return Wide(*(const StoredWide *)(values + pieces[0].row));
    double numbers[Lanes<float>::COUNT];
    for (Int k = 0; k < Lanes<float>::COUNT; k++) numbers[k] = values[pieces[k].row];
    return Wide(*(const StoredWide *)numbers);
  };
  const Wide duration = read(spans.after, spans.time_row) - read(spans.before, spans.time_row);
  fine = is_full ? ~Bits(0) : bits_of(__builtin_convertvector(duration, V) * width <= spans.finest);
  for (Int j = 0; j < n; j++) {
    const Wide angle = read(spans.before, j), turns = (angle * 0.159154943091895336 + 6755399441055744.0) - 6755399441055744.0;
    start[j] = __builtin_convertvector(scene.joints[j].is_prismatic != 0 ? angle : angle - turns * 6.28318530717958648, V);
    chord[j] = __builtin_convertvector(read(spans.after, j) - angle, V);
    first[j] = __builtin_convertvector(read(spans.before, n + j) * duration, V);
    last[j] = __builtin_convertvector(read(spans.after, n + j) * duration, V);
  }
  for (Int j = 0; j < n; j++) {
    const V second = 3.0f * chord[j] - 2.0f * first[j] - last[j], third = first[j] + last[j] - 2.0f * chord[j];
    // Bernstein coefficients of the piece and of its derivative, between which the values are.
    const V a = begin * (first[j] + begin * (second + begin * third)), d = end * (first[j] + end * (second + end * third));
    const V u = first[j] + begin * (2.0f * second + begin * 3.0f * third), w = first[j] + end * (2.0f * second + end * 3.0f * third);
    const V v = u + width * (second + begin * 3.0f * third), b = a + width / 3.0f * u, c = d - width / 3.0f * w;
    speed[j] = larger(larger(__builtin_elementwise_abs(u), __builtin_elementwise_abs(v)), __builtin_elementwise_abs(w));
    const V low = smaller(smaller(a, b), smaller(c, d)), high = larger(larger(a, b), larger(c, d));
    q[j] = start[j] + 0.5f * (low + high);
    deviation[j] = 0.5f * (high - low);
  }
  Frame<float> frames[MAX_LINKS];
  compute_frames(scene.joint_count, scene.joints, q, frames);
  // A point of a link moves by at most m = sum_j (lever_j + m) deviation_j, because its distance from an axis changes by at most m.
  V turn = {}, moved[MAX_LINKS][MAX_JOINTS + 1], rates[MAX_LINKS][MAX_JOINTS + 1];  // by the joints from each one on
  V turn_rate = {};
  for (Int j = 0; j < n; j++)
    if (scene.joints[j].is_prismatic == 0) turn += deviation[j], turn_rate += speed[j];
  const V needed = width == 0.0f ? V{} - spans.allowance : V{} + spans.allowance, factor = 1.0f / larger(1.0f - turn, V{} + 1e-6f);
  for (Int link = 1; link <= n; link++) {
    const Sphere<float> &around = scene.part_enclosing[link];
    const Point<V> center = frames[link].transform(around.x, around.y, around.z);
    moved[link][link] = rates[link][link] = V{};
    for (Int j = link - 1; j >= 0; j--) {
      const Frame<float> &axis = frames[j + 1];
      const Point<V> arm = {center.x - axis.p[0], center.y - axis.p[1], center.z - axis.p[2]};
      const V along = axis.r[2] * arm.x + axis.r[5] * arm.y + axis.r[8] * arm.z;
      V lever = square_root(larger(dot(arm, arm) - along * along, V{})) + around.radius;
      if (scene.joints[j].is_prismatic != 0) lever = V{} + 1.0f;
      moved[link][j] = moved[link][j + 1] + factor * deviation[j] * lever;
      rates[link][j] = rates[link][j + 1] + speed[j] * lever;
    }
    link_motions[link] = needed + moved[link][0];
  }
  for (Int k = 0; k < scene.link_pair_count; k++)
    pair_motions[k] = needed + moved[scene.link_pairs[k].second_link][scene.link_pairs[k].first_link];
  return bits_of(find_too_close<float, false, true>(scene, frames, link_motions, pair_motions, [&](Int pair, auto near, Int first, Int second) {
    if (bits_of(near) & fine) report(pair, bits_of(near) & fine, rates[second][first] + moved[second][first] * turn_rate);
  }));
}

// ---- routes -----------------------------------------------------------------------------------------------------------------

struct Random {
  Bits state;
  float uniform() {
    Bits z = (state += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return float((z ^ (z >> 31)) >> 40) * 0x1p-24f;
  }
};

INLINE Row load(const float *values) { return *(const StoredRow *)values; }

// ``to - from``, in the shorter direction for joints without limits.
INLINE Row subtract(const Problem &problem, Row to, Row from) {
  Row difference = to - from, revolution = load(problem.revolution);
  Row turns = difference / (revolution + (revolution == 0.0f ? Row{} + 1.0f : Row{}));
  return difference - revolution * ((turns + 12582912.0f) - 12582912.0f);
}

INLINE float squared_norm(const Problem &problem, Row difference) {
  Row scaled = difference * load(problem.scale);
  return sum_of(scaled * scaled);
}

INLINE float measure_length(const Problem &problem, Row difference) {
  if (!problem.has_largest_joint_metric) return __builtin_sqrtf(squared_norm(problem, difference));
  return __builtin_reduce_max(__builtin_elementwise_abs(difference * load(problem.scale)));
}

INLINE bool is_free(const Scene<float> &scene, const Problem &problem, Row start, Row difference) {
  return is_edge_free(scene, (const float *)&start, (const float *)&difference, problem.sample_spacing, problem.room);
}

struct Tree {
  StoredRow *nodes;
  int *parents;
  Int count;
  void add(Row node, Int parent) { nodes[count] = node, parents[count++] = int(parent); }
  Int find_nearest(const Problem &problem, Row q) const {
    Int nearest = 0;
    float least = squared_norm(problem, subtract(problem, q, nodes[0]));
    for (Int k = 1; k < count; k++) {
      const float square = squared_norm(problem, subtract(problem, q, nodes[k]));
      if (square < least) least = square, nearest = k;
    }
    return nearest;
  }
};

// Grow two trees until they meet (RRT-Connect), and write the waypoints from the start to a goal. Returns their number; 0 if
// the trees did not meet, below 0 if the route has too many waypoints. ``goal`` gets the index of the goal.
static Int connect_trees(const Scene<float> &scene, const Problem &problem, Row start, const StoredRow *goals, Int goal_count,
                         Random &random, StoredRow *route, Int *goal) {
  Tree trees[2] = {{problem.nodes, problem.parents, 0}, {problem.nodes + problem.max_nodes, problem.parents + problem.max_nodes, 0}};
  trees[0].add(start, -1);
  for (Int k = 0; k < goal_count; k++) trees[1].add(goals[k], -1);
  const Row low = load(problem.low), size = load(problem.high) - low;
  for (Int round = 0; round < problem.max_rounds; round++) {
    // The smaller tree grows; the other one grows towards its new node.
    const Int grown = trees[0].count > trees[1].count;
    Tree &growing = trees[grown], &other = trees[1 - grown];
    if (growing.count >= problem.max_nodes || other.count >= problem.max_nodes) return 0;
    Row sample = low;
    for (Int j = 0; j < scene.joint_count; j++) sample[j] += size[j] * random.uniform();
    const Int near = growing.find_nearest(problem, sample);
    Row step = subtract(problem, sample, growing.nodes[near]);
    float length = measure_length(problem, step);
    if (length > problem.largest_step) step *= problem.largest_step / length;
    if (length == 0 || !is_free(scene, problem, growing.nodes[near], step)) continue;
    growing.add(growing.nodes[near] + step, near);
    const Row target = growing.nodes[growing.count - 1];
    Int end = other.find_nearest(problem, target);
    while (true) {
      step = subtract(problem, target, other.nodes[end]);
      length = measure_length(problem, step);
      const bool arrives = length <= problem.largest_step;
      if (!arrives) step *= problem.largest_step / length;
      if (!is_free(scene, problem, other.nodes[end], step)) break;
      if (arrives) {
        Int ends[2] = {grown ? end : growing.count - 1, grown ? growing.count - 1 : end};
        Int count = 0;
        for (Int k = ends[0]; k >= 0; k = trees[0].parents[k]) {
          if (count == MAX_POINTS) return -1;
          route[count++] = trees[0].nodes[k];
        }
        for (Int k = 0; k < count / 2; k++) {
          Row last = route[count - 1 - k];
          route[count - 1 - k] = route[k], route[k] = last;
        }
        for (Int k = ends[1]; k >= 0; k = trees[1].parents[k]) {
          *goal = k;
          if (count == MAX_POINTS) return -1;
          route[count] = route[count - 1] + subtract(problem, trees[1].nodes[k], route[count - 1]);
          count++;
        }
        return count;
      }
      if (other.count >= problem.max_nodes) break;
      other.add(other.nodes[end] + step, end);
      end = other.count - 1;
    }
  }
  return 0;
}

// Replace pieces of a route by straight edges, between waypoints and between random points, and return the number of waypoints.
static Int shorten_route(const Scene<float> &scene, const Problem &problem, Random &random, StoredRow *route, Int count) {
  float lengths[MAX_POINTS];
  Int failures = 0;
  for (Int first = 0; first + 2 < count; first++)  // the farthest waypoint that can be reached directly
    for (Int last = count - 1; last > first + 1; last--)
      if (is_free(scene, problem, route[first], route[last] - route[first])) {
        for (Int k = last; k < count; k++) route[first + 1 + k - last] = route[k];
        count -= last - first - 1;
        break;
      }
  while (count > 2 && failures < problem.max_shortcut_failures) {
    lengths[0] = 0;
    for (Int k = 1; k < count; k++) lengths[k] = lengths[k - 1] + measure_length(problem, route[k] - route[k - 1]);
    const float total = lengths[count - 1];
    float places[2] = {random.uniform() * total, random.uniform() * total};
    if (places[0] > places[1]) {
      const float larger_place = places[0];
      places[0] = places[1], places[1] = larger_place;
    }
    Int pieces[2];
    Row ends[2];
    for (Int side = 0; side < 2; side++) {
      Int piece = 0;
      while (piece + 2 < count && lengths[piece + 1] < places[side]) piece++;
      const float size = lengths[piece + 1] - lengths[piece];
      const float fraction = size > 0 ? (places[side] - lengths[piece]) / size : 0.0f;
      ends[side] = route[piece] + fraction * (route[piece + 1] - route[piece]);
      pieces[side] = piece;
    }
    const float gain = places[1] - places[0] - measure_length(problem, ends[1] - ends[0]);
    if (pieces[0] == pieces[1] || gain < 1e-4f * total || count + 2 > MAX_POINTS ||
        !is_free(scene, problem, ends[0], ends[1] - ends[0])) {
      failures++;
      continue;
    }
    if (gain > 1e-2f * total) failures = 0;
    const Int shift = 2 - (pieces[1] - pieces[0]);  // the waypoints between the ends are replaced by the ends
    if (shift > 0)
      for (Int k = count - 1; k > pieces[1]; k--) route[k + shift] = route[k];
    else
      for (Int k = pieces[1] + 1; k < count; k++) route[k + shift] = route[k];
    route[pieces[0] + 1] = ends[0], route[pieces[0] + 2] = ends[1];
    count += shift;
  }
  return count;
}

extern "C" {

// Write 1 for each edge (edges, n) on which no checked configuration is in contact, else 0.
void check_edges(const Scene<float> *scene, const float *starts, const float *differences, Int edges, float spacing, float room,
                 char *free) {
  for (Int k = 0; k < edges; k++)
    free[k] = is_edge_free(*scene, starts + k * scene->joint_count, differences + k * scene->joint_count, spacing, room);
}

// Write 1 for each edge (edges, n) that is proved, else 0.
void prove_edges(const Scene<double> *scene, const double *starts, const double *differences, const double *deviations, Int edges,
                 double resolution, char *proved) {
  const Int n = scene->joint_count;
  for (Int k = 0; k < edges; k++)
    proved[k] = prove_edge(*scene, starts + k * n, differences + k * n, deviations + k * n, resolution);
}

// Write 1 for each edge (edges, n) on which the tool constraints are proved to hold, with ``reserves`` (edges, lengths), else 0.
void prove_constraints(const Manifold *manifold, const double *starts, const double *differences, const double *reserves, Int edges,
                       char *proved) {
  for (Int k = 0; k < edges; k++) {
    const Int n = manifold->joint_count;
    proved[k] = prove_constraints(*manifold, starts + k * n, differences + k * n, reserves + k * manifold->length_count);
  }
}

// See the functions of these names in constraint_manifold.hpp.
void exclude_boxes(const Manifold *manifold, const double *middles, const double *half_widths, Int count, char *is_excluded) {
  exclude_boxes(*manifold, middles, half_widths, count, is_excluded);
}
void evaluate_errors(const Manifold *manifold, const double *q, Int count, double *lengths, double *rows, double *slopes) {
  evaluate_errors(*manifold, q, count, lengths, rows, slopes);
}
void extend_paths(const Manifold *manifold, const Scene<double> *scene, const Extensions *extensions) {
  extend_paths(*manifold, scene, *extensions);
}

// Add a possible contact to one that it continues, or else to the end.
INLINE void add_contact(Contact *contacts, Int &found, Int capacity, const Contact &contact) {
  for (Int k = found - 1; found <= capacity && k >= 0 && k >= found - MAX_COMPARED; k--) {
    Contact &other = contacts[k];
    if (other.pair != contact.pair || other.piece.row != contact.piece.row || other.piece.end != contact.piece.begin) continue;
    other.piece.end = contact.piece.end;
    if (contact.rate > other.rate) other.rate = contact.rate;
    return;
  }
  if (found++ < capacity) contacts[found - 1] = contact;
}

// Write the pieces of spans in which a pair may touch, and return their number, which may exceed the ``capacity``. Write for each
// span whether an instant is found at which it is in contact for certain. Later pieces are not searched.
Int check_spans(const Scene<float> *scene, const Spans *spans, Int rows, Contact *contacts, Int capacity, char *touching) {
  constexpr Int COUNT = Lanes<float>::COUNT;
  SpanPiece waiting[MAX_PIECES];
  Int count = 0, next = 0, found = 0;
  for (Int row = 0; row < rows; row++) touching[row] = 0;
  while (count || next < rows) {
    SpanPiece pieces[COUNT];
    const bool are_consecutive = count < COUNT && next + COUNT <= rows;
    Int used = 0;
    while (used < COUNT && (count || next < rows)) {
      pieces[used] = are_consecutive || !count ? SpanPiece{next++, 0, 1} : waiting[--count];
      used += !touching[pieces[used].row];
    }
    if (!used) break;
    for (Int k = used; k < COUNT; k++) pieces[k] = pieces[0];
    const Bits all_used = (Bits(1) << used) - 1;
    Bits fine;
    Bits open = all_used & find_open(*scene, *spans, pieces, are_consecutive, count + 2 * COUNT > MAX_PIECES, fine, [&](Int pair, Bits lanes, Lanes<float>::V rate) {
      for (lanes &= all_used; lanes; lanes &= lanes - 1) {
        const Int k = __builtin_ctzll(lanes);
        if (pieces[k].begin != pieces[k].end) add_contact(contacts, found, capacity, {pieces[k], pair, 1.001 * rate[k]});
      }
    });
    for (; open; open &= ~(Bits(1) << (63 - __builtin_clzll(open)))) {  // the first pieces are searched next
      const Int k = 63 - __builtin_clzll(open);
      const auto [row, begin, end] = pieces[k];
      const float middle = 0.5f * (begin + end);
      if (begin == end)
        touching[row] = 1;
      else if (fine >> k & 1)
        waiting[count++] = {row, end, end};
      else
        waiting[count++] = {row, middle, end}, waiting[count++] = {row, begin, middle};
    }
  }
  return found;
}

// Search a route (MAX_POINTS, 16) once, shorten it, and return the number of its waypoints; see connect_trees.
Int search_route(const Scene<float> *scene, const Problem *problem, const StoredRow *start, const StoredRow *goals, Int goal_count,
                 Bits seed, StoredRow *route, Int *goal) {
  Random random = {seed};
  const Int count = connect_trees(*scene, *problem, *start, goals, goal_count, random, route, goal);
  return count > 2 ? shorten_route(*scene, *problem, random, route, count) : count;
}

// Shorten a route (MAX_POINTS, 16) further, and return the number of its waypoints.
Int shorten(const Scene<float> *scene, const Problem *problem, StoredRow *route, Int count, Bits seed) {
  Random random = {seed};
  return shorten_route(*scene, *problem, random, route, count);
}
}
