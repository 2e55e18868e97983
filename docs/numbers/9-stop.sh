# Chapter 9: how many samples it takes for an error.
samples() { # KEY OPTIONS...
    key=$1
    shift
    build/demo09 --no-window --out build/numbers/9.png "$@" |
        sed -n "s/.* \([0-9]*\) samples, error.*/$key: \1/p"
}
for sampler in random sobol; do
    samples $sampler-5 160 120 --sampler $sampler --error 0.05
    samples $sampler-3 160 120 --sampler $sampler --error 0.03
done
samples four 160 120 --error 0.04
samples two 160 120 --error 0.02
