"""What inputs/contact/dynamic_ironing.xml is read for: how the response to a cylinder that is dragged over soil oscillates."""
import numpy as np

STEADY = 1.6     # [s] from here on the cylinder has its speed and the start has died away
SAMPLE = 0.004   # [s]
SLOWEST = 6.0    # [Hz] below the frequency at which elements pass, 8 Hz; slower is the block's own motion
CHORD = 0.25     # [m] of the facets: one element
METHODS = ("nodes", "surface quadrature")


def settings(method, approximation):
    """Assignments for --set."""
    chosen = [f"contacts/face/method={method}", f"bodies/die/contour/approximation={approximation}"]
    return chosen + ([f"bodies/die/contour/chord length={CHORD}"] if approximation != "exact" else [])


class Response:
    """Times, drag over the mean normal force, and the soil's horizontal acceleration, with their amplitude spectra."""

    def __init__(self, history):
        late = history.time > STEADY
        self.time = np.arange(history.time[late][0], history.time[-1], SAMPLE)
        normal = self._at(history, "contact/face/reaction y")
        self.normal = normal / normal.mean()
        self.drag = -self._at(history, "contact/face/reaction x") / normal.mean()
        u = self._at(history, "probe/soil/displacement x")
        self.acceleration = np.gradient(np.gradient(u, SAMPLE), SAMPLE)
        self.frequency = np.fft.rfftfreq(len(self.time), SAMPLE)

    def _at(self, history, name):
        return np.interp(self.time, history.time, history[name])

    def spectrum(self, values):
        """Amplitude by frequency, without the slow change along the path (a cubic); Hann's window."""
        window = np.hanning(len(self.time))
        rest = values - np.polyval(np.polyfit(self.time, values, 3), self.time)
        return 2 * np.abs(np.fft.rfft(rest * window)) / window.sum()

    def ripple(self, values):
        """Root of the sum of squared amplitudes above SLOWEST."""
        return np.sqrt((self.spectrum(values)[self.frequency > SLOWEST] ** 2).sum())
