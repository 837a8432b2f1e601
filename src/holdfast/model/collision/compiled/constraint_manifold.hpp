// Tool constraints along edges in joint space, and extensions of paths along them; part of route_search.cpp.
//
// The module tool_constraints/manifold.py explains the bounds. There are one or two lengths of each constraint, that of its
// position error and that of its rotation error, and neither may exceed its bound.

constexpr Int MAX_CHAIN = 64;  // joints of an arm
constexpr Int MAX_EQUATIONS = 24;  // equations of all constraints together, of which each length has up to three
constexpr Int NEWTON_STEPS = 12;
constexpr double EQUATION_TOLERANCE = 1e-8;  // error below which an equation is met, m and rad
constexpr double ROUNDING = 1e-9;  // m and rad
constexpr double CONE_FRACTION = 0.9;  // of a cone's opening, to which axes outside are projected
constexpr double MAX_NEWTON_STEP = 0.3;  // rad or m of one joint
constexpr double SHORTEST_PIECE = 1.0 / 256;  // of an edge; a shorter piece that is not proved counts as a violation
constexpr double NO_BOUND = 1e200;
constexpr double MIN_PROGRESS = 0.1;  // of a step: smallest progress towards the end

typedef Lanes<double>::V Reals;
typedef Lanes<double>::Mask Flags;

struct Constraint {
  Int normal_count, is_turned, has_axis;
  double normals[9], anchor[3], rotation[9], direction[3], axis[3];  // normals by rows; the axis is in the frame of the last link
  double angle;  // half the opening of the cone, rad; 0: the axis is along its direction
};

struct Manifold {
  Int joint_count, constraint_count, length_count;
  const Joint<double> *joints;
  const Constraint *constraints;
  const double *tool;  // (12) rotation by rows, and position, in the frame of the last link
  const double *bounds, *slacks;  // (lengths) largest lengths, and the part of them that a step may use
  const double *low, *high;  // (n) limits, equal for joints that do not move
  const double *is_revolute;  // (n) 1 or 0
  const double *lever_arms;  // (n) largest motion of the tool per unit of each joint
  const double *second_derivatives;  // (n, n) bounds of those of the position
};

struct Extensions {
  const double *starts, *targets;  // (count, n)
  const double *scale;  // (n) of the joints in lengths
  Int has_largest_joint_metric;  // length is the largest scaled joint motion instead of the Euclidean norm
  Int count, max_steps;
  double resolution;  // change of distances, m, below which a piece that is not proved counts as blocked
  const double *zeros;  // (64)
  double *points;  // (count, max_steps, n)
  Int *point_counts;
  char *has_arrived;
};

INLINE Reals absolute(Reals x) { return __builtin_elementwise_abs(x); }

// Lengths of the errors at configurations, and with ``has_rows`` the equations that are not met, with their slopes by joints.
struct Errors {
  Int row_count, end_rows[MAX_EQUATIONS];  // after the rows of each length
  Reals lengths[MAX_EQUATIONS], rows[MAX_EQUATIONS], slopes[MAX_EQUATIONS][MAX_CHAIN];
  Reals ratios[MAX_EQUATIONS];  // of the slopes of a length and of the norm of its rows

  template <bool has_rows> void evaluate(const Manifold &manifold, const Reals *q) {
    typedef Point<Reals> P;
    const Int n = manifold.joint_count;
    Frame<double> frames[MAX_CHAIN + 1];
    compute_frames(n, manifold.joints, q, frames);
    const double *tool = manifold.tool;
    const P position = frames[n].transform(tool[9], tool[10], tool[11]);
    const Reals none = {};
    Int length = 0;
    row_count = 0;
    // Add an equation: the motion of the point, or the rotation, along ``v`` must be ``error``.
    const auto add_row = [&](Reals error, P v, bool is_rotation) {
      rows[row_count] = error;
      for (Int j = 0; j < n; j++) {
        const Frame<double> &frame = frames[j + 1];
        const P z = {frame.r[2], frame.r[5], frame.r[8]};
        const P arm = {position.x - frame.p[0], position.y - frame.p[1], position.z - frame.p[2]};
        const bool is_revolute = manifold.is_revolute[j] != 0;
        Reals slope = is_rotation == is_revolute ? dot(z, v) : none;
        if (!is_rotation && is_revolute)
          slope = v.x * (z.y * arm.z - z.z * arm.y) + v.y * (z.z * arm.x - z.x * arm.z) + v.z * (z.x * arm.y - z.y * arm.x);
        slopes[row_count][j] = slope;
      }
      row_count++;
    };
    const P unit[3] = {{none + 1, none, none}, {none, none + 1, none}, {none, none, none + 1}};
    for (Int k = 0; k < manifold.constraint_count; k++) {
      const Constraint &c = manifold.constraints[k];
      if (c.normal_count) {
        Reals square = none;
        for (Int row = 0; row < c.normal_count; row++) {
          const double *normal = c.normals + 3 * row;
          const Reals error = (c.anchor[0] - position.x) * normal[0] + (c.anchor[1] - position.y) * normal[1] +
                              (c.anchor[2] - position.z) * normal[2];
          square += error * error;
          if (has_rows) add_row(error, {none + normal[0], none + normal[1], none + normal[2]}, false);
        }
        ratios[length] = none + 1.0, end_rows[length] = row_count;
        lengths[length++] = square_root(square);
      }
      if (c.is_turned) {
        Reals square = none;
        P turn = {none, none, none};  // the axis of the rotation that is missing, times the sine of its angle
        for (Int column = 0; column < 3; column++) {
          const double axis[3] = {tool[column], tool[3 + column], tool[6 + column]};
          const P now = frames[n].rotate(axis);
          const double *r = c.rotation + column;
          const P gap = {now.x - r[0], now.y - r[3], now.z - r[6]};
          square += dot(gap, gap);
          turn.x += 0.5 * (now.y * r[6] - now.z * r[3]), turn.y += 0.5 * (now.z * r[0] - now.x * r[6]);
          turn.z += 0.5 * (now.x * r[3] - now.y * r[0]);
        }
        // The chord grows with the angle up to 180 deg, and for small errors it is the angle.
        const Reals chord = square_root(0.5 * square), scale = chord / larger(square_root(dot(turn, turn)), none + 1e-12);
        if (has_rows)
          add_row(turn.x * scale, unit[0], true), add_row(turn.y * scale, unit[1], true), add_row(turn.z * scale, unit[2], true);
        ratios[length] = square_root(2.0 * larger(1.0 - 0.25 * chord * chord, none)), end_rows[length] = row_count;
        lengths[length++] = square_root(square);
      } else if (c.has_axis) {
        const double *d = c.direction;
        const P axis = frames[n].rotate(c.axis);
        const P across = {axis.y * d[2] - axis.z * d[1], axis.z * d[0] - axis.x * d[2], axis.x * d[1] - axis.y * d[0]};
        const P gap = {axis.x - d[0], axis.y - d[1], axis.z - d[2]};
        const Reals chord = square_root(dot(gap, gap)), sine = square_root(dot(across, across));
        const Reals cosine = axis.x * d[0] + axis.y * d[1] + axis.z * d[2];
        // The axis of the rotation that is missing; where the tool points exactly away, any perpendicular axis.
        const auto is_parallel = sine < 1e-9, is_along_y = axis.x * axis.x > 0.5;
        const P turn = {is_parallel ? (is_along_y ? -axis.z : none) : across.x, is_parallel ? (is_along_y ? none : axis.z) : across.y,
                        is_parallel ? (is_along_y ? axis.x : -axis.y) : across.z};
        const Reals scale = 1.0 / square_root(dot(turn, turn));
        if (has_rows && c.angle == 0) {
          const Reals components[3] = {axis.x, axis.y, axis.z}, errors[3] = {turn.x, turn.y, turn.z};
          for (Int row = 0; row < 3; row++) {
            const Reals a = components[row];
            const P v = {unit[row].x - a * axis.x, unit[row].y - a * axis.y, unit[row].z - a * axis.z};
            add_row(errors[row] * chord * scale, v, true);
          }
        } else if (has_rows) {
          Reals allowed_sine, edge_sine, allowed_cosine, edge_cosine;
          sine_and_cosine(none + 0.5 * CONE_FRACTION * c.angle, allowed_sine, allowed_cosine);
          sine_and_cosine(none + 0.5 * (c.angle - ROUNDING), edge_sine, edge_cosine);
          const auto is_outside = chord > 2.0 * edge_sine;
          const Reals half_cosine = square_root(larger(1.0 - 0.25 * chord * chord, none + 0.01)), used = is_outside ? scale : none;
          const Reals error = is_outside ? (chord - 2.0 * allowed_sine) / half_cosine : none;
          add_row(error, {turn.x * used, turn.y * used, turn.z * used}, true);
        }
        ratios[length] = cosine > 0.0 ? cosine : none + NO_BOUND, end_rows[length] = row_count;
        lengths[length++] = cosine > 0.0 ? sine : 2.0 - sine;  // beyond 90 deg it points away, for any sine
      }
    }
  }
};

// Bounds of the second derivatives of the errors along motions ``d``.
INLINE void bound_curvature(const Manifold &manifold, const Reals *d, Reals *bounds) {
  const Int n = manifold.joint_count;
  Reals turn = {}, position = {};
  for (Int j = 0; j < n; j++) turn += absolute(d[j]) * manifold.is_revolute[j];
  for (Int j = 0; j < n; j++)
    for (Int k = 0; k < n; k++) position += absolute(d[j]) * absolute(d[k]) * manifold.second_derivatives[j * n + k];
  Int length = 0;
  for (Int k = 0; k < manifold.constraint_count; k++) {
    const Constraint &c = manifold.constraints[k];
    if (c.normal_count) bounds[length++] = position;
    if (c.is_turned || c.has_axis) bounds[length++] = turn * turn * (c.is_turned ? 1.41421356237309515 : 1.0);
  }
}

// Write 1 for each box around q (count, n) in which a constraint is violated everywhere, else 0. From the middle of the box, the
// length of an error changes by at most its slopes there, and half its second derivative.
static void exclude_boxes(const Manifold &manifold, const double *middles, const double *half_widths, Int count, char *is_excluded) {
  constexpr Int COUNT = Lanes<double>::COUNT;
  const Int n = manifold.joint_count;
  const Reals none = {};
  Reals q[MAX_CHAIN], half[MAX_CHAIN], curvature[MAX_EQUATIONS], motion = none, turn = none;
  for (Int j = 0; j < n; j++) {
    half[j] = none + half_widths[j];
    motion += half[j] * manifold.lever_arms[j], turn += half[j] * manifold.is_revolute[j];
  }
  bound_curvature(manifold, half, curvature);
  Errors errors;
  for (Int first = 0; first < count; first += COUNT) {
    for (Int j = 0; j < n; j++)
      for (Int k = 0; k < COUNT; k++) q[j][k] = middles[(first + k < count ? first + k : first) * n + j];
    errors.evaluate<true>(manifold, q);
    Flags is_violated = none < none;
    Int length = 0;
    const auto check_length = [&](Reals largest_change) {
      const Int first_row = length ? errors.end_rows[length - 1] : 0, end_row = errors.end_rows[length];
      Reals square = none, change = none;
      for (Int row = first_row; row < end_row; row++) square += errors.rows[row] * errors.rows[row];
      for (Int j = 0; j < n; j++) {
        Reals slope = none;
        for (Int row = first_row; row < end_row; row++) slope += errors.rows[row] * errors.slopes[row][j];
        change += absolute(slope) * half[j];
      }
      change = change * errors.ratios[length] / larger(square_root(square), none + 1e-12) + 0.5 * curvature[length];
      change = errors.ratios[length] < NO_BOUND ? smaller(change, largest_change) : largest_change;
      is_violated |= errors.lengths[length] - change > manifold.bounds[length] + 2 * ROUNDING;
      length++;
    };
    for (Int k = 0; k < manifold.constraint_count; k++) {
      const Constraint &c = manifold.constraints[k];
      if (c.normal_count) check_length(motion);
      if (c.is_turned || c.has_axis) check_length(turn * (c.is_turned ? 1.41421356237309515 : 1.0));
    }
    for (Int k = 0; k < COUNT && first + k < count; k++) is_excluded[first + k] = is_violated[k] != 0;
  }
}

// Write the lengths (count, lengths) of the errors at q (count, n), the rows (count, rows), and their slopes (count, rows, n).
static void evaluate_errors(const Manifold &manifold, const double *q, Int count, double *lengths, double *rows, double *slopes) {
  constexpr Int COUNT = Lanes<double>::COUNT;
  const Int n = manifold.joint_count;
  Reals lanes[MAX_CHAIN];
  Errors errors;
  for (Int first = 0; first < count; first += COUNT) {
    for (Int j = 0; j < n; j++)
      for (Int k = 0; k < COUNT; k++) lanes[j][k] = q[(first + k < count ? first + k : first) * n + j];
    errors.evaluate<true>(manifold, lanes);
    for (Int k = 0; k < COUNT && first + k < count; k++) {
      for (Int length = 0; length < manifold.length_count; length++) *lengths++ = errors.lengths[length][k];
      for (Int row = 0; row < errors.row_count; row++) {
        *rows++ = errors.rows[row][k];
        for (Int j = 0; j < n; j++) *slopes++ = errors.slopes[row][j][k];
      }
    }
  }
}

// Step of least length that removes the errors, in which joints that it would push beyond their limits do not move.
static void take_newton_step(const Manifold &manifold, const Errors &errors, Reals *q, Flags moving) {
  const Int n = manifold.joint_count, rows = errors.row_count;
  const Reals none = {};
  Reals movable[MAX_CHAIN], step[MAX_CHAIN], gram[MAX_EQUATIONS][MAX_EQUATIONS], solution[MAX_EQUATIONS], largest = none + 1e-12;
  for (Int j = 0; j < n; j++) movable[j] = none + (manifold.low[j] < manifold.high[j]);
  for (Int pass = 0; pass < 2; pass++) {
    Reals trace = none;
    for (Int a = 0; a < rows; a++)
      for (Int b = 0; b <= a; b++) {
        Reals sum = none;
        for (Int j = 0; j < n; j++) sum += errors.slopes[a][j] * errors.slopes[b][j] * movable[j];
        gram[a][b] = sum;
        if (a == b) trace += sum;
      }
    for (Int a = 0; a < rows; a++) {  // Cholesky, of which the diagonal contains the inverse
      gram[a][a] += 1e-10 * trace + 1e-14;
      solution[a] = errors.rows[a];
      for (Int b = 0; b < a; b++) {
        for (Int c = 0; c < b; c++) gram[a][b] -= gram[a][c] * gram[b][c];
        gram[a][b] *= gram[b][b];
        gram[a][a] -= gram[a][b] * gram[a][b];
        solution[a] -= gram[a][b] * solution[b];
      }
      gram[a][a] = 1.0 / square_root(larger(gram[a][a], none + 1e-30));
      solution[a] *= gram[a][a];
    }
    for (Int a = rows - 1; a >= 0; a--) {
      for (Int b = a + 1; b < rows; b++) solution[a] -= gram[b][a] * solution[b];
      solution[a] *= gram[a][a];
    }
    Flags is_blocked = none < none;
    for (Int j = 0; j < n; j++) {
      step[j] = none;
      for (Int a = 0; a < rows; a++) step[j] += errors.slopes[a][j] * solution[a];
      step[j] *= movable[j];
      const Flags is_beyond = ((q[j] <= manifold.low[j]) & (step[j] < 0.0)) | ((q[j] >= manifold.high[j]) & (step[j] > 0.0));
      if (pass == 0) movable[j] = is_beyond ? none : movable[j];
      is_blocked |= is_beyond;
    }
    if (!any(is_blocked)) break;
  }
  for (Int j = 0; j < n; j++) largest = larger(largest, absolute(step[j]));
  const Reals scale = smaller(none + 1.0, MAX_NEWTON_STEP / largest);
  for (Int j = 0; j < n; j++) {
    const Reals moved = smaller(larger(q[j] + scale * step[j], none + manifold.low[j]), none + manifold.high[j]);
    q[j] = moving & (movable[j] > 0.0) ? moved : q[j];
  }
}

// Project configurations onto the constraints, which may fail, and compute the lengths of the errors there.
static void project(const Manifold &manifold, Reals *q, Flags moving, Errors &errors) {
  const Reals none = {};
  for (Int round = 0;; round++) {
    errors.evaluate<true>(manifold, q);
    Reals largest = none;
    for (Int row = 0; row < errors.row_count; row++) largest = larger(largest, absolute(errors.rows[row]));
    const Flags unmet = moving & (largest > EQUATION_TOLERANCE);
    if (round == NEWTON_STEPS || !any(unmet)) return;
    take_newton_step(manifold, errors, q, unmet);
  }
}

// Prove that all constraints hold on the straight edge from ``start``, and leave the ``reserves`` of their lengths.
static bool prove_constraints(const Manifold &manifold, const double *start, const double *difference, const double *reserves) {
  constexpr Int COUNT = Lanes<double>::COUNT;
  const Int n = manifold.joint_count;
  Reals d[MAX_CHAIN], q[MAX_CHAIN], curvature[MAX_EQUATIONS], first[MAX_EQUATIONS];
  for (Int j = 0; j < n; j++) d[j] = Reals{} + difference[j];
  bound_curvature(manifold, d, curvature);
  struct Piece { double begin, width; } waiting[MAX_PIECES];
  Int count = 0;
  waiting[count++] = {0, 1};
  Errors errors;
  while (count) {
    Piece pieces[COUNT];
    Reals begin, width;
    const Int used = count < COUNT ? count : COUNT;
    for (Int k = 0; k < COUNT; k++) {
      pieces[k] = waiting[count - 1 - (k < used ? k : 0)];
      begin[k] = pieces[k].begin, width[k] = pieces[k].width;
    }
    count -= used;
    for (Int j = 0; j < n; j++) q[j] = start[j] + begin * difference[j];
    errors.evaluate<false>(manifold, q);
    for (Int k = 0; k < manifold.length_count; k++) first[k] = errors.lengths[k];
    for (Int j = 0; j < n; j++) q[j] = start[j] + (begin + width) * difference[j];
    errors.evaluate<false>(manifold, q);
    Flags open = begin < begin, is_violated = begin < begin;
    for (Int k = 0; k < manifold.length_count; k++) {
      const Reals margin = manifold.bounds[k] + ROUNDING - reserves[k] - larger(first[k], errors.lengths[k]);
      open |= !(margin >= 0.125 * width * width * curvature[k]);
      is_violated |= !(margin >= 0.0);
    }
    if (any(is_violated)) return false;
    for (Int k = 0; k < used; k++) {
      if (!open[k]) continue;
      const double half = pieces[k].width / 2;
      if (half < SHORTEST_PIECE || count + 2 > MAX_PIECES) return false;
      waiting[count++] = {pieces[k].begin, half};
      waiting[count++] = {pieces[k].begin + half, half};
    }
  }
  return true;
}

INLINE Reals measure_length(const Extensions &paths, Int joint_count, const Reals *difference) {
  Reals square = {}, largest = {};
  for (Int j = 0; j < joint_count; j++) {
    const Reals scaled = absolute(difference[j] * paths.scale[j]);
    square += scaled * scaled, largest = larger(largest, scaled);
  }
  return paths.has_largest_joint_metric ? largest : square_root(square);
}

// Extend paths from starts towards targets, as far as each step comes nearer and is proved valid. Each step uses up at most half
// the slack of a constraint, and ends where the constraints are met. Without a ``scene`` collisions are not checked.
static void extend_paths(const Manifold &manifold, const Scene<double> *scene, const Extensions &paths) {
  constexpr Int COUNT = Lanes<double>::COUNT;
  const Int n = manifold.joint_count;
  const Reals none = {};
  Reals q[MAX_CHAIN], targets[MAX_CHAIN], remaining[MAX_CHAIN], steps[MAX_CHAIN], candidates[MAX_CHAIN], curvature[MAX_EQUATIONS];
  Int path[COUNT], next = 0, active = 0;
  Flags may_arrive = none < none;
  Errors errors;
  for (Int k = 0; k < COUNT; k++) path[k] = -1;
  for (Int j = 0; j < n; j++) q[j] = targets[j] = none;
  while (true) {
    const bool has_new_paths = active < COUNT && next < paths.count;
    for (Int k = 0; k < COUNT && next < paths.count; k++) {
      if (path[k] >= 0) continue;
      path[k] = next++, active++;
      for (Int j = 0; j < n; j++) q[j][k] = paths.starts[path[k] * n + j], targets[j][k] = paths.targets[path[k] * n + j];
      paths.point_counts[path[k]] = 0, paths.has_arrived[path[k]] = 0;
    }
    if (!active) return;
    if (has_new_paths) {  // only a valid target may become the last point
      errors.evaluate<false>(manifold, targets);
      may_arrive = none == none;
      for (Int j = 0; j < n; j++) may_arrive &= (targets[j] >= manifold.low[j]) & (targets[j] <= manifold.high[j]);
      for (Int k = 0; k < manifold.length_count; k++) may_arrive &= errors.lengths[k] <= manifold.bounds[k] + ROUNDING;
    }
    for (Int j = 0; j < n; j++) remaining[j] = targets[j] - q[j];
    const Reals distance = measure_length(paths, n, remaining);
    bound_curvature(manifold, remaining, curvature);
    Reals fraction = none + 1.0;
    for (Int k = 0; k < manifold.length_count; k++)
      fraction = smaller(fraction, square_root(4 * manifold.slacks[k] / larger(curvature[k], none + 1e-300)));
    for (Int j = 0; j < n; j++) steps[j] = fraction * remaining[j];
    const Flags is_last = (fraction == 1.0) & may_arrive;
    for (Int j = 0; j < n; j++) {
      const Reals next_q = smaller(larger(q[j] + steps[j], none + manifold.low[j]), none + manifold.high[j]);
      candidates[j] = is_last ? targets[j] : next_q;
    }
    project(manifold, candidates, ~is_last, errors);
    const Reals step_length = measure_length(paths, n, steps);
    for (Int j = 0; j < n; j++) remaining[j] = targets[j] - candidates[j], steps[j] = candidates[j] - q[j];
    const Flags is_closer = (distance > 0.0) & (distance - measure_length(paths, n, remaining) > MIN_PROGRESS * step_length);
    for (Int k = 0; k < COUNT; k++) {
      if (path[k] < 0) continue;
      double start[MAX_CHAIN], difference[MAX_CHAIN];
      for (Int j = 0; j < n; j++) start[j] = q[j][k], difference[j] = steps[j][k];
      const bool is_valid = is_closer[k] && prove_constraints(manifold, start, difference, paths.zeros) &&
                            (!scene || prove_edge(*scene, start, difference, paths.zeros, paths.resolution));
      Int &count = paths.point_counts[path[k]];
      if (is_valid)
        for (Int j = 0; j < n; j++) {
          q[j][k] = candidates[j][k];
          paths.points[(path[k] * paths.max_steps + count) * n + j] = q[j][k];
        }
      count += is_valid;
      if (is_valid && !is_last[k] && count < paths.max_steps) continue;
      paths.has_arrived[path[k]] = is_valid && is_last[k];
      path[k] = -1, active--;
    }
  }
}
