# rt.h in Python: the errors that docs/python/noise.py prints, and the time of one call.
# Slow: it needs numpy, and an idle machine.
for python in python3 /usr/bin/python3; do $python -c "import numpy" 2>/dev/null && break; done
folder=build/numbers/python
mkdir -p $folder && cp rt.h docs/python/*.py $folder && cd $folder || exit
table=$($python noise.py 2>/dev/null) || exit
printf '```\n%s\n```\n' "$table"
echo "$table" | awk '$1 == 256 { printf "times: %.1f\n", $3 / $2 }'
$python - <<'END'
import timeit
import rt
scene = rt.scene(spheres=[((0, 0, -5), 1)])
ray, hit = rt.Ray(direction=(0, 0, -1)), rt.Hit()
intersect = rt.function("rt_intersect")
times = timeit.repeat(lambda: intersect(scene, ray, hit), number=100000, repeat=9)
print("call: %.1f" % (min(times) * 10))  # in millionths of a second
END
