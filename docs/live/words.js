/* What the live pictures say, in English or French, as the browser wants; and how elements are made. */

const french = {
    'samples': 'échantillons', 'bounces': 'rebonds', 'reset everything': 'tout réinitialiser', 'the camera': 'la caméra',
    'the ball': 'la boule', 'the mirror': 'le miroir', 'mirror': 'miroir', 'the cube': 'le cube', 'the lamp': 'la lampe', 'move': 'déplacer',
    'left': 'à gauche', 'right': 'à droite', 'up': 'en haut', 'down': 'en bas', 'nearer': 'plus près', 'farther': 'plus loin',
    'from above': 'vu d’en haut', 'from the side': 'vu de côté', 'close': 'fermer', 'sample': 'échantillon', 'The path': 'Le chemin', 'The path in words': 'Le chemin en mots', 'previous sample': 'échantillon précédent',
    'next sample': 'échantillon suivant', 'on the left': 'à gauche', 'the chapter before': 'le chapitre précédent',
    'one sample': 'un seul échantillon', 'other numbers': 'd’autres nombres', 'with its noise': 'avec son bruit',
    'yours': 'la vôtre', 'The picture is now beside the editor.': 'L’image est maintenant à côté de l’éditeur.', 'right one': 'la bonne', 'rt.h\'s own function': 'la fonction de rt.h',
    'rays at a time': 'rayons à la fois', 'workers': 'fils', 'worker': 'fil', 'ray at a time': 'rayon à la fois', 'random': 'aléatoires',
    'sphere': 'sphère', 'walls': 'murs', 'cube': 'cube', 'shadows': 'ombres', 'indirect light': 'lumière indirecte', 'glass': 'verre', 'lamps': 'lampes', 'gloss': 'brillance', 'lens and sky': 'objectif et ciel', 'patterns': 'motifs', 'triangles': 'triangles', 'your own shape': 'une forme à soi', 'the teapot': 'la théière', 'the pedestal': 'le socle', 'height': 'hauteur', 'the glass ball': 'la boule de verre', 'radius': 'rayon', 'shininess': 'brillance', 'refractive index': 'indice de réfraction', 'exposure': 'exposition', 'more': 'plus', 'less': 'moins', 'camera': 'caméra', 'red sphere': 'sphère rouge', 'left wall': 'mur gauche', 'right wall': 'mur droit', 'back wall': 'mur du fond', 'floor': 'sol', 'ceiling': 'plafond', 'glass ball': 'boule de verre', 'teapot': 'théière', 'pedestal': 'socle', 'meets': 'rencontre', 'on it': 'où', 'goes on': 'continue', 'throughput': 'reste', 'adds': 'ajoute', 'matt': 'mat', 'normal': 'normale', 'lamp': 'lampe', 'in shadow': 'à l’ombre', 'without noise': 'sans bruit', 'Sobol points': 'nombres de Sobol',
    'as in chapter': 'comme au chapitre', 'The picture is done.': 'L’image est terminée.', 'error': 'erreur', 'gamma': 'gamma',
    'million rays a second': 'millions de rayons par seconde', 'This picture cannot move here': 'Cette image ne peut pas bouger ici',
};
const t = navigator.language?.startsWith('fr') ? words => french[words] ?? words : words => words;

/* An element: make('button', {class: 'x', text: 'y'}, child...). */
function make(name, attributes = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (key === 'text')
            element.textContent = value;
        else if (key.startsWith('on'))
            element[key] = value;
        else if (value !== false)
            element.setAttribute(key, value === true ? '' : value);
    }
    element.append(...children);
    return element;
}

/* What the viewer says of its progress. */
function in_words(line) {
    if (t('samples') === 'samples')
        return line;
    const words = {samples: 'échantillons', sample: 'échantillon', error: 'erreur', finished: 'débruitée', 'at most': 'au plus', wanted: 'voulus',
        unknown: 'inconnue', 'direct light': 'lumière directe', 'a second': 'par seconde', 'Mrays/s': 'millions de rayons par seconde'};
    return Object.entries(words).reduce((text, [english, ours]) => text.replace(english, ours), line);
}
