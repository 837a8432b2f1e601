from holdfast.certificates.claims import ReachClaim as ReachClaim
from holdfast.certificates.claims import reach_claim as reach_claim
from holdfast.certificates.proof import CertificateCheck as CertificateCheck
from holdfast.certificates.proof import Proof as Proof
from holdfast.certificates.proof import certify as certify
from holdfast.certificates.proof import check_certificate as check_certificate
