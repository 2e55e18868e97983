/* The ray tracer of the report's kind, to compare with: C++ classes, a virtual is_hit, doubles,
 * a recursive getColor, one thread. Written the way a good student would after the lecture, with
 * no tricks and no deliberate slowness; only the numbers of the room come from demos/scene.h.
 * It estimates the same as rt_radiance: the light of the lamp at every matt hit, one random
 * direction after it, mirrors, five bounces in all.
 *
 *     naive [WIDTH HEIGHT SAMPLES [PICTURE.ppm]]
 *
 * prints millions of rays per second, rays per sample, and the mean red, green and blue. */
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "../../demos/scene.h"

class Vector
{
  public:
    double x, y, z;
    Vector(double x = 0, double y = 0, double z = 0) : x(x), y(y), z(z)
    {
    }
    Vector(const rt_vec3 &v) : x(v.x), y(v.y), z(v.z)
    {
    }
    double dot(const Vector &v) const
    {
        return x * v.x + y * v.y + z * v.z;
    }
    double norm2() const
    {
        return dot(*this);
    }
    double length() const
    {
        return sqrt(norm2());
    }
    Vector normalized() const;
};

Vector operator+(const Vector &a, const Vector &b)
{
    return Vector(a.x + b.x, a.y + b.y, a.z + b.z);
}

Vector operator-(const Vector &a, const Vector &b)
{
    return Vector(a.x - b.x, a.y - b.y, a.z - b.z);
}

Vector operator*(const Vector &a, const Vector &b)
{
    return Vector(a.x * b.x, a.y * b.y, a.z * b.z);
}

Vector operator*(double k, const Vector &v)
{
    return Vector(k * v.x, k * v.y, k * v.z);
}

Vector cross(const Vector &a, const Vector &b)
{
    return Vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

Vector Vector::normalized() const
{
    return (1 / length()) * *this;
}

class Ray
{
  public:
    Vector origin, direction; // the direction is a unit vector
    Ray(const Vector &origin, const Vector &direction)
        : origin(origin), direction(direction)
    {
    }
};

class Object
{
  public:
    Vector albedo;
    bool mirror;
    Object(const rt_material &m) : albedo(m.albedo), mirror(m.mirror)
    {
    }
    virtual ~Object()
    {
    }
    // Is there a hit in front of the ray? Then its point, normal and distance.
    virtual bool is_hit(const Ray &ray, Vector &P, Vector &N, double &t) const = 0;
};

class Sphere : public Object
{
    Vector center;
    double radius;

  public:
    Sphere(const rt_sphere &s) : Object(s.material), center(s.center), radius(s.radius)
    {
    }

    bool is_hit(const Ray &ray, Vector &P, Vector &N, double &t) const override
    {
        Vector OC = ray.origin - center;
        double b = 2 * ray.direction.dot(OC);
        double c = OC.norm2() - radius * radius;
        double delta = b * b - 4 * c;
        if (delta < 0)
            return false;
        double root = sqrt(delta);
        t = (-b - root) / 2;
        if (t <= 0)
            t = (-b + root) / 2;
        if (t <= 0)
            return false;
        P = ray.origin + t * ray.direction;
        N = (P - center).normalized();
        return true;
    }
};

class Cube : public Object
{
    Vector low, high;

    Vector normal(const Vector &P) const // of the face on which P lies
    {
        const double epsilon = 1e-6;
        if (fabs(P.x - low.x) < epsilon)
            return Vector(-1, 0, 0);
        if (fabs(P.x - high.x) < epsilon)
            return Vector(1, 0, 0);
        if (fabs(P.y - low.y) < epsilon)
            return Vector(0, -1, 0);
        if (fabs(P.y - high.y) < epsilon)
            return Vector(0, 1, 0);
        if (fabs(P.z - low.z) < epsilon)
            return Vector(0, 0, -1);
        return Vector(0, 0, 1);
    }

  public:
    Cube(const rt_box &b) : Object(b.material), low(b.min), high(b.max)
    {
    }

    bool is_hit(const Ray &ray, Vector &P, Vector &N, double &t) const override
    {
        double x0 = (low.x - ray.origin.x) / ray.direction.x;
        double x1 = (high.x - ray.origin.x) / ray.direction.x;
        double y0 = (low.y - ray.origin.y) / ray.direction.y;
        double y1 = (high.y - ray.origin.y) / ray.direction.y;
        double z0 = (low.z - ray.origin.z) / ray.direction.z;
        double z1 = (high.z - ray.origin.z) / ray.direction.z;
        double t_min = std::max({std::min(x0, x1), std::min(y0, y1), std::min(z0, z1)});
        double t_max = std::min({std::max(x0, x1), std::max(y0, y1), std::max(z0, z1)});
        if (t_min > t_max || t_max <= 0)
            return false;
        t = t_min > 0 ? t_min : t_max;
        P = ray.origin + t * ray.direction;
        N = normal(P);
        return true;
    }
};

static std::default_random_engine engine(10);
static std::uniform_real_distribution<double> uniform(0, 1);

// A random direction around N, with the cosine as its density.
Vector random_cos(const Vector &N)
{
    double r1 = uniform(engine), r2 = uniform(engine);
    double x = cos(2 * M_PI * r1) * sqrt(1 - r2);
    double y = sin(2 * M_PI * r1) * sqrt(1 - r2);
    double z = sqrt(r2);
    Vector other = fabs(N.x) > 0.5 ? Vector(0, 1, 0) : Vector(1, 0, 0);
    Vector tangent1 = cross(N, other).normalized();
    Vector tangent2 = cross(N, tangent1);
    return x * tangent1 + y * tangent2 + z * N;
}

class Scene
{
  public:
    std::vector<Object *> objects;
    Vector light, intensity;
    long rays = 0; // traced, of every kind

    bool intersect(const Ray &ray, const Object *&object, Vector &P, Vector &N, double &t)
    {
        bool found = false;
        rays++;
        t = 1e30;
        for (const Object *candidate : objects) {
            Vector candidate_P, candidate_N;
            double candidate_t;
            if (candidate->is_hit(ray, candidate_P, candidate_N, candidate_t) &&
                candidate_t < t) {
                found = true;
                object = candidate;
                P = candidate_P;
                N = candidate_N;
                t = candidate_t;
            }
        }
        return found;
    }

    Vector getColor(const Ray &ray, int bounces)
    {
        const Object *object, *other;
        Vector P, N, other_P, other_N;
        double t, other_t;
        if (!intersect(ray, object, P, N, t))
            return Vector(0, 0, 0);
        Vector start = P + 0.001 * N; // off the surface

        if (object->mirror) {
            if (bounces == 0)
                return Vector(0, 0, 0);
            Vector R = ray.direction - 2 * ray.direction.dot(N) * N;
            return object->albedo * getColor(Ray(start, R), bounces - 1);
        }

        Vector color;
        double d2 = (light - P).norm2();
        Vector L = (light - P).normalized();
        if (N.dot(L) > 0) {
            bool shadow = intersect(Ray(start, L), other, other_P, other_N, other_t) &&
                          other_t * other_t < d2;
            if (!shadow)
                color = N.dot(L) / (M_PI * d2) * object->albedo * intensity;
        }
        if (bounces > 0)
            color =
                color + object->albedo * getColor(Ray(start, random_cos(N)), bounces - 1);
        return color;
    }
};

int main(int argc, char **argv)
{
    int W = argc > 3 ? atoi(argv[1]) : 640;
    int H = argc > 3 ? atoi(argv[2]) : 480;
    int samples = argc > 3 ? atoi(argv[3]) : 4;

    Scene scene;
    for (int i = 0; i < scene_indirect.sphere_count; i++)
        scene.objects.push_back(new Sphere(room_spheres[i]));
    scene.objects.push_back(new Cube(room_cube));
    scene.light = Vector(room_dim_light.position);
    scene.intensity = Vector(room_dim_light.intensity);

    Vector position(room_camera.position);
    Vector forward = Vector(room_camera.direction).normalized();
    Vector right = cross(forward, Vector(room_camera.up)).normalized();
    Vector top = cross(right, forward);
    double size = 2 * tan(room_camera.fov_y * M_PI / 360) / H; // of a pixel

    std::vector<Vector> image(W * H);
    auto begin = std::chrono::steady_clock::now();
    for (int j = 0; j < H; j++) {
        for (int i = 0; i < W; i++) {
            Vector sum;
            for (int k = 0; k < samples; k++) {
                double x = (i + uniform(engine) - W / 2.) * size;
                double y = (H / 2. - j - uniform(engine)) * size;
                Vector u = (forward + x * right + y * top).normalized();
                sum = sum + scene.getColor(Ray(position, u), 5);
            }
            image[j * W + i] = (1. / samples) * sum;
        }
    }
    std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;

    Vector mean;
    for (const Vector &pixel : image)
        mean = mean + (1. / (W * H)) * pixel;
    printf("%.4f\t%.3f\t%.6f %.6f %.6f\n", scene.rays / took.count() / 1e6,
           scene.rays / ((double)W * H * samples), mean.x, mean.y, mean.z);

    if (argc > 4) {
        FILE *file = fopen(argv[4], "wb");
        if (!file)
            return perror(argv[4]), 1;
        fprintf(file, "P6 %d %d 255\n", W, H);
        for (const Vector &pixel : image)
            for (double value : {pixel.x, pixel.y, pixel.z})
                putc((int)(255 * pow(std::min(value, 1.), 1 / 2.2) + 0.5), file);
        fclose(file);
    }
    for (Object *object : scene.objects)
        delete object;
    return 0;
}
