# Chapter 18: a job array, killed half way and resumed. Slow: it renders a picture twice.
make -s build/demo08 >/dev/null || exit
folder=build/numbers/18-resume
rm -rf $folder && mkdir -p $folder && cd $folder || exit
PATH=$(pwd)/../..:$PATH
options="640 480 --out room.png"
seq 60 >list
array="xargs -P 2 -I@ demo08 $options --threads 1 --part @/60"
echo '```'
echo "\$ seq 60 | $array"
echo "# in another terminal: pkill -KILL 'xargs|demo08'"
$array <list >log 2>&1 &
while [ ! -e room-part-20-of-60.part ]; do sleep 0.1; done
kill -KILL $! $(ps -A -o pid=,ppid= | awk -v x=$! '$2 == x { print $1 }') 2>/dev/null
wait 2>/dev/null
sleep 0.5
echo "\$ demo08 $options --join 60"
demo08 $options --join 60 2>&1
echo "\$ seq 60 | $array | tail -n 1"
$array <list 2>/dev/null >log
tail -n 1 log
echo "\$ demo08 $options --join 60"
demo08 $options --join 60
echo "\$ demo08 640 480 --no-window --quiet --out whole.png; cmp room.png whole.png && echo the same"
demo08 640 480 --no-window --quiet --out whole.png
cmp room.png whole.png && echo the same
echo '```'
echo "there: $(grep -c 'there already' log)"
echo "rendered: $(grep -c wrote log)"
