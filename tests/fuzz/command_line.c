/* libFuzzer: the bytes are a command line, its words separated by zeros. command_parse accepts it
 * with settings in range, or refuses it. */
#define RT_IMPLEMENTATION
#include "../../demos/command.c"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static char text[4096];
    char *argv[66] = {"demo", NULL};
    int argc = 1;
    const demo d = {.name = "demo", .title = "fuzz"};
    settings s = {.width = 640, .height = 480, .samples = 1, .out = "a.png"};
    if (size == 0 || size >= sizeof text)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    for (size_t at = 0; at < size && argc < 65; at += strlen(text + at) + 1)
        argv[argc++] = text + at;
    argv[argc] = NULL;
    if (!command_parse(&d, argc, argv, &s))
        return 0;
    if (s.width < 1 || s.height < 1 || s.width * s.height > COMMAND_PIXELS ||
        s.samples < 0 || s.samples > INT_MAX || s.bounces < 0 || s.bounces > INT_MAX ||
        s.threads < 0 || s.threads > 1024 || s.seed < 0 || s.seed > UINT32_MAX ||
        strlen(s.out) < 4 || (s.lanes != 0 && rt_lane_count((int)s.lanes) != s.lanes) ||
        !(s.error >= 0.0f && s.error <= FLT_MAX) ||
        !(s.seconds >= 0.0f && s.seconds <= FLT_MAX) ||
        (s.sampler != RT_SOBOL && s.sampler != RT_RANDOM))
        abort();
    return 0;
}
