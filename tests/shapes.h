/* Answers to the exercises of chapter 17: functions for rt_custom_shape, each with its data. All
 * compute in double and round once, at the end, so that P lies on the surface. */
#ifndef TESTS_SHAPES_H
#define TESTS_SHAPES_H

#include "../rt.h"

/* ---- a plane -------------------------------------------------------------------------- */

/* Endless: the box of the rt_custom_shape cuts it off. */
typedef struct plane {
    rt_vec3 point, normal; /* normal: any length, to its outside */
} plane;

static inline bool plane_hit(const void *data, const rt_ray *ray, float t_max,
                             rt_hit *hit)
{
    const plane *p = (const plane *)data;
    const rt_dvec3 o = rt_to_double(ray->origin), u = rt_to_double(ray->direction);
    const rt_dvec3 n = rt_to_double(p->normal);
    const double along = rt_ddot(u, n);
    if (along == 0.0)
        return false;
    const double t = rt_ddot(rt_dsub(rt_to_double(p->point), o), n) / along;
    if (!(t > 0.0 && t < (double)t_max))
        return false;
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(o, t, u));
    hit->normal = p->normal;
    return true;
}

/* ---- a cone --------------------------------------------------------------------------- */

/* Upright, its tip above the middle of its foot. */
typedef struct cone {
    rt_vec3 base;
    float radius, height;
} cone;

/* Inside is where a t^2 + 2 b t + c < 0, from *in to *out; of the two cones, tip to tip, that this
 * describes, the lower one. False: nowhere. */
static inline bool cone_range(double a, double b, double c, bool down, double *in,
                              double *out)
{
    const double d = b * b - a * c;
    *in = -1e300;
    *out = 1e300;
    if (a > 0.0) { /* through one of the two */
        *in = (-b - sqrt(d > 0.0 ? d : 0.0)) / a;
        *out = (-b + sqrt(d > 0.0 ? d : 0.0)) / a;
        return d > 0.0;
    }
    /* Steeper than the side: inside one, then inside the other. The solutions of a t^2 +
     * 2 b t + c are s / a and c / s, so nothing is lost where a is almost 0. */
    const double root = sqrt(d > 0.0 ? d : 0.0), s = b > 0.0 ? -b - root : root - b;
    if (s == 0.0)
        return false;
    const double t = c / s, other = a < 0.0 ? s / a : t;
    if (a == 0.0) /* as steep: one solution */
        *(b > 0.0 ? out : in) = t;
    else if (down)
        *in = t > other ? t : other;
    else
        *out = t < other ? t : other;
    return true;
}

static inline bool cone_hit(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const cone *c = (const cone *)data;
    const rt_dvec3 o = rt_to_double(ray->origin), u = rt_to_double(ray->direction);
    const rt_dvec3 f = rt_dsub(o, rt_to_double(c->base));
    const double height = (double)c->height, k = (double)c->radius / height;
    const double below = height - f.y; /* the tip */
    double in, out;
    if (!cone_range(u.x * u.x + u.z * u.z - k * k * u.y * u.y,
                    f.x * u.x + f.z * u.z + k * k * below * u.y,
                    f.x * f.x + f.z * f.z - k * k * below * below, u.y < 0.0, &in, &out))
        return false;
    const double t0 = u.y != 0.0 ? -f.y / u.y : f.y > 0.0 ? -1e300 : 1e300;
    const double t1 = u.y != 0.0 ? below / u.y : below > 0.0 ? 1e300 : -1e300;
    const double low = t0 < t1 ? t0 : t1, high = t0 < t1 ? t1 : t0;
    const bool foot_in = low > in && u.y > 0.0, foot_out = high < out && u.y < 0.0;
    in = low > in ? low : in;
    out = high < out ? high : out;
    const double t = in > 0.0 ? in : out;
    if (!(in < out && t > 0.0 && t < (double)t_max))
        return false;
    const rt_dvec3 p = rt_dmad(f, t, u);
    const double flat = sqrt(p.x * p.x + p.z * p.z);
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(o, t, u));
    hit->normal = (in > 0.0 ? foot_in : foot_out) ? rt_vec(0.0f, -1.0f, 0.0f)
                  : flat > 0.0 ? rt_to_float(rt_dvec(p.x, k * flat, p.z))
                               : rt_vec(0.0f, 1.0f, 0.0f); /* the tip */
    return true;
}

/* ---- what rt.h has, as shapes that can be turned or cut -------------------------------- */

/* rt_hit_sphere and rt_hit_box turn the normal to the ray; here it must point outward. */
static inline bool ball_hit(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const rt_sphere *s = (const rt_sphere *)data;
    if (!rt_hit_sphere(s, ray, t_max, hit))
        return false;
    hit->normal = rt_sub(hit->point, s->center);
    return true;
}

static inline bool cube_hit(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const rt_box *b = (const rt_box *)data;
    if (!rt_hit_box(b, ray, t_max, hit))
        return false;
    const rt_vec3 middle = rt_scale(rt_add(b->min, b->max), 0.5f);
    if (rt_dot(rt_sub(hit->point, middle), hit->normal) < 0.0f)
        hit->normal = rt_scale(hit->normal, -1.0f);
    return true;
}

/* ---- turned and stretched: turn the ray, not the shape --------------------------------- */

/* The shape in a world of its own, whose (0,0,0) is put at middle and whose axes are put
 * along x, y, z: perpendicular to each other, and as long as the shape is to be
 * stretched. */
typedef struct turned {
    rt_vec3 middle, x, y, z;
    const rt_custom_shape *shape;
} turned;

/* v in the shape's own world. */
static inline rt_vec3 into(const turned *d, rt_dvec3 v)
{
    const rt_dvec3 x = rt_to_double(d->x), y = rt_to_double(d->y), z = rt_to_double(d->z);
    return rt_to_float(rt_dvec(rt_ddot(v, x) / rt_ddot(x, x),
                               rt_ddot(v, y) / rt_ddot(y, y),
                               rt_ddot(v, z) / rt_ddot(z, z)));
}

static inline bool turned_hit(const void *data, const rt_ray *ray, float t_max,
                              rt_hit *hit)
{
    const turned *d = (const turned *)data;
    const rt_dvec3 middle = rt_to_double(d->middle);
    rt_ray own;
    own.origin = into(d, rt_dsub(rt_to_double(ray->origin), middle));
    own.direction = into(d, rt_to_double(ray->direction)); /* so t stays what it is */
    if (!rt_hit_custom_shape(d->shape, &own, t_max, hit))
        return false;
    const rt_dvec3 x = rt_to_double(d->x), y = rt_to_double(d->y), z = rt_to_double(d->z);
    const rt_dvec3 p = rt_to_double(hit->point);
    const rt_dvec3 n = rt_dscale(rt_to_double(hit->normal), hit->inside ? -1.0 : 1.0);
    const rt_dvec3 px = rt_dmad(middle, p.x, x), pxy = rt_dmad(px, p.y, y);
    const rt_dvec3 nx = rt_dscale(x, n.x / rt_ddot(x, x)); /* what is stretched by k, */
    const rt_dvec3 nxy = rt_dmad(nx, n.y / rt_ddot(y, y), y); /* tilts N by 1/k */
    hit->point = rt_to_float(rt_dmad(pxy, p.z, z));
    hit->normal = rt_to_float(rt_dmad(nxy, n.z / rt_ddot(z, z), z));
    return true;
}

/* ---- a distance ------------------------------------------------------------------------ */

/* How far P is from the surface, or less; below 0 inside. */
typedef double distance_function(const void *data, rt_dvec3 point);

typedef struct field {
    distance_function *distance;
    const void *data;
} field;

/* Its slope there, in steps of h. */
static inline rt_vec3 slope_of(const field *f, rt_dvec3 p, double h)
{
    const double x = f->distance(f->data, rt_dvec(p.x + h, p.y, p.z)) -
                     f->distance(f->data, rt_dvec(p.x - h, p.y, p.z));
    const double y = f->distance(f->data, rt_dvec(p.x, p.y + h, p.z)) -
                     f->distance(f->data, rt_dvec(p.x, p.y - h, p.z));
    const double z = f->distance(f->data, rt_dvec(p.x, p.y, p.z + h)) -
                     f->distance(f->data, rt_dvec(p.x, p.y, p.z - h));
    return rt_to_float(rt_dscale(rt_dvec(x, y, z), 0.5 / h));
}

/* The ray may go on so far without meeting the surface; and again, and again, until the
 * sign changes. Then halve the last step until it is a point. Steps are never shorter
 * than a rounding of P, or a ray along the surface would take for ever. */
static inline bool field_hit(const void *data, const rt_ray *ray, float t_max,
                             rt_hit *hit)
{
    const field *f = (const field *)data;
    const rt_dvec3 o = rt_to_double(ray->origin), u = rt_to_double(ray->direction);
    const double length = sqrt(rt_ddot(u, u));
    const bool inside = f->distance(f->data, o) < 0.0;
    double t = 0.0, before = 0.0;
    for (int step = 0; step < 5000 && t < (double)t_max; step++) {
        const rt_dvec3 p = rt_dmad(o, t, u);
        const double d = f->distance(f->data, p);
        const double least = 1e-7 * (1.0 + fabs(p.x) + fabs(p.y) + fabs(p.z));
        if ((d < 0.0) == inside) {
            before = t;
            t += (fabs(d) > least ? fabs(d) : least) / length;
            continue;
        }
        for (int k = 0; k < 60; k++) {
            const double half = 0.5 * (before + t);
            const bool same = (f->distance(f->data, rt_dmad(o, half, u)) < 0.0) == inside;
            before = same ? half : before;
            t = same ? t : half;
        }
        const rt_dvec3 q = rt_dmad(o, t, u);
        hit->t = (float)t;
        hit->point = rt_to_float(q);
        hit->normal = slope_of(f, q, 10.0 * least);
        return (float)t > 0.0f && (float)t < t_max;
    }
    return false;
}

/* A ring, lying flat. */
typedef struct ring {
    rt_vec3 middle;
    float radius, half; /* of the ring, and half of its thickness */
} ring;

static inline double ring_distance(const void *data, rt_dvec3 point)
{
    const ring *r = (const ring *)data;
    const rt_dvec3 p = rt_dsub(point, rt_to_double(r->middle));
    const double out = sqrt(p.x * p.x + p.z * p.z) - (double)r->radius;
    return sqrt(out * out + p.y * p.y) - (double)r->half;
}

/* ---- union, intersection, difference
 * ---------------------------------------------------- */

typedef struct pair {
    enum { A_OR_B, A_AND_B, A_WITHOUT_B } rule;
    const rt_custom_shape *a, *b; /* closed: what goes in comes out */
} pair;

static inline bool is_in_pair(const pair *p, bool in_a, bool in_b)
{
    return p->rule == A_OR_B    ? in_a || in_b
           : p->rule == A_AND_B ? in_a && in_b
                                : in_a && !in_b;
}

/* The next point of A or B after the last hit of the ray. The resulting t is the whole
 * way. */
static inline bool next_hit(const rt_custom_shape *shape, const rt_ray *ray, rt_hit *hit,
                            double *t)
{
    rt_ray on = *ray;
    if (*t > 0.0)
        on.origin = rt_leave(hit->point, hit->normal, ray->direction);
    if (!rt_hit_custom_shape(shape, &on, FLT_MAX, hit))
        return false;
    *t += (double)hit->t;
    return true;
}

/* Takes one hit after the other from each of the two; hit->inside says whether the ray
 * comes out there. The first one at which the ray enters or leaves the pair is the
 * answer. */
static inline bool pair_hit(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const pair *p = (const pair *)data;
    rt_hit a, b;
    double t_a = 0.0, t_b = 0.0;
    bool more_a = next_hit(p->a, ray, &a, &t_a), more_b = next_hit(p->b, ray, &b, &t_b);
    for (int k = 0; k < 100 && (more_a || more_b); k++) {
        const bool is_a = more_a && (!more_b || t_a < t_b);
        const bool in_a = more_a && a.inside, in_b = more_b && b.inside;
        const bool before = is_in_pair(p, in_a, in_b);
        const bool behind =
            is_a ? is_in_pair(p, !in_a, in_b) : is_in_pair(p, in_a, !in_b);
        if (before != behind) {
            *hit = is_a ? a : b;
            hit->t = (float)(is_a ? t_a : t_b);
            if (before) /* the normal is on the side of the ray: inside */
                hit->normal = rt_scale(hit->normal, -1.0f);
            return hit->t < t_max;
        }
        if (is_a)
            more_a = next_hit(p->a, ray, &a, &t_a);
        else
            more_b = next_hit(p->b, ray, &b, &t_b);
    }
    return false;
}

#endif
