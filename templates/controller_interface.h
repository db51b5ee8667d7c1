#define {{ names.upper }}_STATES {{ tables.states }}
#define {{ names.upper }}_INPUTS {{ tables.inputs }}
{% if tables.steers %}#define {{ names.upper }}_GROUP {{ tables.group }}
{% endif %}#define {{ names.upper }}_HORIZON {{ tables.horizon }}u
{% if let Some(m) = tables.memory %}#define {{ names.upper }}_START {{ m.memories }}
{% endif %}
enum {{ names.prefix }}_status {
    {{ names.upper }}_{{ names.act }} = 0,
    {{ names.upper }}_REACHED = 1,
    {{ names.upper }}_UNSAFE = 2,
    {{ names.upper }}_OUTSIDE = 3,
    {{ names.upper }}_NO_ACTION = 4,
    {{ names.upper }}_OVER = 5
};

enum {{ names.prefix }}_status {{ names.function }}(
    const double x[{{ names.upper }}_STATES], uint32_t k,{% if tables.memory.is_some() %} uint32_t *memory,{% endif %} double {{ names.array }});
