/* Ways to meet a triangle, in REAL arithmetic: float or double. */

typedef struct NAME(vector) {
    REAL x, y, z;
} NAME(vector);

static inline NAME(vector) NAME(minus)(rt_vec3 a, rt_vec3 b)
{
    const NAME(vector)
        d = {(REAL)a.x - (REAL)b.x, (REAL)a.y - (REAL)b.y, (REAL)a.z - (REAL)b.z};
    return d;
}

static inline NAME(vector) NAME(cross)(NAME(vector) a, NAME(vector) b)
{
    const NAME(vector)
        c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return c;
}

static inline REAL NAME(dot)(NAME(vector) a, NAME(vector) b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* T. Moeller, B. Trumbore, 1997: the linear equations by Cramer's rule. What is not larger than
 * epsilon counts as parallel. */
static inline bool NAME(cramer)(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                REAL epsilon, rt_hit *hit)
{
    const rt_vec3 a = rt_corner(mesh, triangle, 0), zero = {0, 0, 0};
    const NAME(vector) ab = NAME(minus)(rt_corner(mesh, triangle, 1), a);
    const NAME(vector) ac = NAME(minus)(rt_corner(mesh, triangle, 2), a);
    const NAME(vector) d = NAME(minus)(ray->direction, zero), p = NAME(cross)(d, ac);
    const REAL det = NAME(dot)(ab, p);
    if (det >= -epsilon && det <= epsilon)
        return false;
    const NAME(vector) s = NAME(minus)(ray->origin, a), q = NAME(cross)(s, ab);
    const REAL inverse = 1 / det, u = NAME(dot)(s, p) * inverse;
    const REAL v = NAME(dot)(d, q) * inverse, t = NAME(dot)(ac, q) * inverse;
    hit->t = (float)t;
    return u >= 0 && u <= 1 && v >= 0 && u + v <= 1 && t > epsilon;
}

/* As the chapter has it, if 0 is inside. */
static inline bool NAME(sheared)(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                 bool zero_is_inside, float t_max, rt_hit *hit)
{
    const rt_dvec3 u = rt__turned(ray->direction, rt__shear_of(ray).axis);
    const REAL z = 1 / (REAL)u.z, x = (REAL)u.x * z, y = (REAL)u.y * z;
    NAME(vector) c[3];
    for (int k = 0; k < 3; k++) {
        const int axis = rt__shear_of(ray).axis;
        const rt_dvec3 p = rt__turned(rt_corner(mesh, triangle, k), axis);
        const rt_dvec3 o = rt__turned(ray->origin, axis);
        c[k].z = (REAL)p.z - (REAL)o.z;
        c[k].x = ((REAL)p.x - (REAL)o.x) - x * c[k].z;
        c[k].y = ((REAL)p.y - (REAL)o.y) - y * c[k].z;
    }
    const REAL w_a = c[2].x * c[1].y - c[2].y * c[1].x;
    const REAL w_b = c[0].x * c[2].y - c[0].y * c[2].x;
    const REAL w_c = c[1].x * c[0].y - c[1].y * c[0].x, sum = w_a + w_b + w_c;
    if ((w_a < 0 || w_b < 0 || w_c < 0) && (w_a > 0 || w_b > 0 || w_c > 0))
        return false;
    if (!zero_is_inside && (w_a == 0 || w_b == 0 || w_c == 0))
        return false;
    hit->t = (float)((w_a * c[0].z + w_b * c[1].z + w_c * c[2].z) * z / sum);
    return sum != 0 && hit->t > 0 && hit->t < t_max;
}
