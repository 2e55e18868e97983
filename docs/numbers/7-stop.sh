# Chapter 7, exercise 3: how many random samples it takes for an error.
for error in 0.05 0.025; do
    build/demo07 80 60 --no-window --error $error --out build/numbers/7.png |
        sed -n "s/.* \([0-9]*\) samples, error.*/samples$error: \1/p"
done
