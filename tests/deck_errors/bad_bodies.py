"""Bodies that cannot be, cannot move so, or cannot be held."""
from wrong_deck import Wrong, parameter, section, whole

BOTH = (1, 2)
MOTION, CONTOUR = whole("motion"), whole("contour")
POSITION = parameter("position", "Array(double)", "{0.0, 0.3}")
MASS = parameter("mass", "double", "20")
PUSH = parameter("duration", "double", "0.001")


def motion(*entries, water=""):
    inner = "".join(f"        {entry}\n" for entry in entries)
    return f'      <ParameterList name="motion">\n{inner}{water}      </ParameterList>\n'


def contour(*entries, pieces=""):
    inner = "".join(f"        {entry}\n" for entry in entries)
    return f'      <ParameterList name="contour">\n{inner}{pieces}      </ParameterList>\n'


def water(*entries):
    return '<ParameterList name="water">' + "".join(entries) + "</ParameterList>\n"


def stage_motion(body, *entries):
    return f'<ParameterList name="motions"><ParameterList name="{body}">' + "".join(entries) + "</ParameterList></ParameterList>"


FREE = parameter("type", "string", "free")
FORCE = parameter("type", "string", "force")
LIGHT = (POSITION, POSITION)
HEAVY = (POSITION, POSITION + MASS)
FALL = (MOTION, motion(FREE))
QUASI_STATIC = [('value="dynamic"', 'value="quasi-static"'), (whole("integrator"), "")]
INTERVAL = parameter("initial", "double", "2.5e-4")

BALL = whole("ball on clay")

DECKS = [
    Wrong("two contacts of one pair", (BALL, BALL + BALL.replace("ball on clay", "twin")),
          "contacts/twin: presses surface 'top' with body 'ball' in stage 'push', as contact 'ball on clay' does: the "
          "traction would count twice; allowed: one of them in a stage", at=section("twin"), ranks=BOTH),
    Wrong("fall without mass", FALL, "bodies/ball/motion/type: a free body needs a 'mass' greater than 0", at=FREE, ranks=BOTH),
    Wrong("force without mass", (MOTION, motion(FORCE)),
          "stages/push: body 'ball' is released in this dynamic stage: it needs a 'mass' greater than 0", at=section("push"), ranks=BOTH),
    Wrong("rotation of half a body", (POSITION, POSITION + "\n" + parameter("rotation", "Array(double)", "{10.0}")),
          "bodies/ball/rotation: a body with a half contour stands upright on its axis: it takes no rotation; in plane strain a contour of 'extent' = full does",
          at=parameter("rotation", "Array(double)", "{10.0}")),
    Wrong("negative mass", (POSITION, POSITION + parameter("mass", "double", "-1")), "bodies/ball/mass: -1 is out of range; allowed: [0, inf)"),
    Wrong("unknown freedom", [HEAVY, (MOTION, motion(FREE, parameter("freedom", "Array(string)", "{y, spin}")))],
          "bodies/ball/motion/freedom: unknown direction 'spin'; known: x, y, rotation", at="freedom"),
    Wrong("sideways on the axis", [HEAVY, (MOTION, motion(FREE, parameter("freedom", "Array(string)", "{x, y}")))],
          "bodies/ball/motion/freedom: an axisymmetric body moves along its axis only: its freedom is y", at="freedom"),
    Wrong("force on a held direction", [HEAVY, (MOTION, motion(FREE, parameter("force x", "double", "3")))],
          "bodies/ball/motion/force x: the body does not move in this direction (its 'freedom' lacks x)", at="force x"),
    Wrong("thrown sideways", [HEAVY, (MOTION, motion(FREE, parameter("initial velocity", "Array(double)", "{1, 0}")))],
          "bodies/ball/motion/initial velocity: the body does not move in this direction (its 'freedom' lacks x)", at="initial velocity"),
    Wrong("drag without water", [HEAVY, (MOTION, motion(FREE, water=water(parameter("drag coefficient", "double", "0.5"))))],
          "bodies/ball/motion/water/drag coefficient: there is no water: its 'density' is 0 or missing", at="drag coefficient"),
    Wrong("floating without volume", [HEAVY, (CONTOUR, contour(parameter("type", "string", "cone"), parameter("diameter", "double", "0.1"))),
                                      (MOTION, motion(FREE, water=water(parameter("density", "double", "1000"))))],
          "bodies/ball/motion/water/density: the body's contour is open: its buoyancy needs a 'volume' of the body", at='name="density"'),
    Wrong("held by nothing", [HEAVY, FALL] + QUASI_STATIC + [(PUSH, PUSH + parameter("contacts", "Array(string)", "{none}"))],
          "stages/push: body 'ball' is released in this quasi-static stage, but no contact that acts in it could hold the body; "
          "name the motion 'held'", at=section("push")),
    Wrong("moved in a geostatic stage", [HEAVY, FALL, ('value="geostatic"/>\n      <Parameter name="balance',
                                                       'value="geostatic"/>' + stage_motion("ball", FREE) + '\n      <Parameter name="balance')],
          "stages/geostatic/motions: bodies rest in a geostatic stage, which takes no time: it has no 'motions'", at='name="motions"'),
    Wrong("motion of nobody", (PUSH, PUSH + stage_motion("bal", FREE)),
          "stages/push/motions/bal: unknown body 'bal' (did you mean 'ball'?)", at='name="motions"'),
    Wrong("body below the soil", [("{0.0, 0.3}", "{0.0, -5}")],
          "contacts/ball on clay/body: body 'ball' lies below the surface: its top is at -4.8 m, the surface reaches down to 0.3 m; "
          "move its 'position'", at=parameter("body", "string", "ball"), ranks=BOTH),
    Wrong("inverted contour", (CONTOUR, contour(parameter("type", "string", "polyline"), parameter("x", "Array(double)", "{0, 0.1, 0}"),
                                                parameter("y", "Array(double)", "{0.2, 0.1, 0}"))),
          "bodies/ball/contour: the contour is inverted: the body must lie on the left of the path from the first point to the last "
          "(from the tip up the right-hand side)", at=section("contour")),
    Wrong("contour that crosses itself",
          (CONTOUR, contour(parameter("type", "string", "polyline"), parameter("x", "Array(double)", "{0, 0.2, 0.1, 0.1, 0}"),
                            parameter("y", "Array(double)", "{0, 0.1, 0.15, -0.1, 0.3}"))),
          "bodies/ball/contour: the contour crosses itself near (0.1, 0.05)", at=section("contour")),
    Wrong("facets without a length", ('value="0.2"/>\n      </', 'value="0.2"/>' + parameter("approximation", "string", "facets") + "\n      </"),
          "bodies/ball/contour/approximation: an approximation needs a 'chord length' greater than 0", at="approximation"),
]
